// SPDX-License-Identifier: LGPL-2.1-or-later
#include <array>
#include <optional>
#include <tuple>
#include <vector>

#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"
#include "error.h"
#include "interruptible.h"
#include "tools/cad_shape.h"
#include "tools/cone.h"
#include "tools/cylinder.h"
#include "tools/face.h"
#include "tools/patch.h"
#include "tools/plane.h"
#include "tools/sphere.h"
#include "tools/torus.h"

namespace py = pybind11;

namespace femscalpel::bindings {
namespace {

using Triple = std::array<double, 3>;

Eigen::Vector3d vector(const Triple& t) { return {t[0], t[1], t[2]}; }
Triple triple(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// A value for each of the points.
template <class Function>
py::array_t<double> at_each(const RealArray& points, Function value) {
    const std::vector<double> values = interruptible([&, data = points.data(), count = points.shape(0)] {
        std::vector<double> out;
        SparseCheck check(256);
        for (py::ssize_t i = 0; i < count; ++i, check())
            out.push_back(value(Eigen::Map<const Eigen::Vector3d>(data + 3 * i)));
        return out;
    });
    return copied<double>(values);
}

void bind_base(py::module_& module) {
    py::class_<Tool>(
        module, "Tool",
        "Base class of the tools, not made itself. A tool is a surface with a positive side, known by its signed\n"
        "distance.")
        .def_property_readonly("kind", &Tool::kind,
                               "What the surface is called in reports and messages, such as \"plane\".")
        .def_property_readonly(
            "feature_size", &Tool::feature_size,
            "Smallest radius of curvature, or infinity: the mesh must be finer than this to follow the surface.")
        .def(
            "distances",
            [](const Tool& tool, const RealArray& points) {
                if (points.ndim() != 2 || points.shape(1) != 3) throw Error("points must have the shape (n, 3)");
                return at_each(points, [&](const Eigen::Vector3d& x) { return tool.distance(x); });
            },
            py::arg("points"));
}

void bind_analytic_surfaces(py::module_& module) {
    py::class_<Plane, Tool>(module, "Plane")
        .def(py::init([](const Triple& origin, const Triple& normal) { return Plane(vector(origin), vector(normal)); }),
             py::arg("origin"), py::arg("normal"))
        .def_property_readonly("origin", [](const Plane& plane) { return triple(plane.origin()); })
        .def_property_readonly("unit_normal", [](const Plane& plane) { return triple(plane.unit_normal()); });
    py::class_<Cylinder, Tool>(module, "Cylinder")
        .def(py::init([](const Triple& origin, const Triple& axis, double radius) {
                 return Cylinder(vector(origin), vector(axis), radius);
             }),
             py::arg("origin"), py::arg("axis"), py::arg("radius"))
        .def_property_readonly("origin", [](const Cylinder& cylinder) { return triple(cylinder.origin()); })
        .def_property_readonly("unit_axis", [](const Cylinder& cylinder) { return triple(cylinder.unit_axis()); })
        .def_property_readonly("radius", &Cylinder::radius, "In the mesh's unit.");
    py::class_<Sphere, Tool>(module, "Sphere")
        .def(py::init([](const Triple& center, double radius) { return Sphere(vector(center), radius); }),
             py::arg("center"), py::arg("radius"))
        .def_property_readonly("center", [](const Sphere& sphere) { return triple(sphere.center()); })
        .def_property_readonly("radius", &Sphere::radius, "In the mesh's unit.");
    py::class_<Torus, Tool>(module, "Torus")
        .def(py::init([](const Triple& center, const Triple& axis, double major_radius, double minor_radius) {
                 return Torus(vector(center), vector(axis), major_radius, minor_radius);
             }),
             py::arg("center"), py::arg("axis"), py::arg("major_radius"), py::arg("minor_radius"))
        .def_property_readonly("center", [](const Torus& torus) { return triple(torus.center()); })
        .def_property_readonly("unit_axis", [](const Torus& torus) { return triple(torus.unit_axis()); })
        .def_property_readonly("major_radius", &Torus::major_radius, "Of the circle, in the mesh's unit.")
        .def_property_readonly("minor_radius", &Torus::minor_radius, "Of the tube around it, in the mesh's unit.");
    py::class_<Cone, Tool>(module, "Cone")
        .def(py::init([](const Triple& origin, const Triple& axis, double radius, double half_angle) {
                 return Cone(vector(origin), vector(axis), radius, half_angle);
             }),
             py::arg("origin"), py::arg("axis"), py::arg("radius"), py::arg("half_angle"))
        .def_property_readonly("origin", [](const Cone& cone) { return triple(cone.origin()); })
        .def_property_readonly("unit_axis", [](const Cone& cone) { return triple(cone.unit_axis()); })
        .def_property_readonly("apex", [](const Cone& cone) { return triple(cone.apex()); })
        .def_property_readonly("radius", &Cone::radius, "At the origin, in the mesh's unit.")
        .def_property_readonly("half_angle", &Cone::half_angle, "Degrees between the axis and the surface.");
}

void bind_cad(py::module_& module) {
    py::class_<Face, Tool>(module, "Face")
        // In this order: bytes would pass for a path too.
        .def(py::init([](const py::bytes& brep) { return Face::from_brep(brep); }), py::arg("brep"))
        .def(py::init([](const std::string& path) { return Face::read(path); }), py::arg("path"))
        .def_property_readonly("face_count", &Face::face_count, "Number of faces.")
        .def(
            "beyond",
            [](const Face& face, const RealArray& points) {
                if (points.ndim() != 2 || points.shape(1) != 3) throw Error("points must have the shape (n, 3)");
                return at_each(points, [&](const Eigen::Vector3d& x) { return face.beyond(x); });
            },
            py::arg("points"),
            "How far the point of the face closest to each of `points`, shape (n, 3), lies beyond the face's border; "
            "negative\n"
            "inside it.");

    py::class_<CadShape>(module, "CadShape")
        .def(py::init([](const py::bytes& brep) { return CadShape::from_brep(brep); }), py::arg("brep"))
        .def(py::init([](const std::string& path) { return CadShape::read(path); }), py::arg("path"))
        .def_property_readonly("face_count", &CadShape::face_count, "Number of faces.")
        .def_property_readonly("edge_count", &CadShape::edge_count, "Number of edges.");
}

void bind_within(py::module_& module) {
    // NOLINTNEXTLINE(bugprone-unused-raii): what it makes stays in the module.
    py::class_<Within>(module, "Within", "Base class of what a crack can be kept within, not made itself.");
    py::class_<Disk, Within>(module, "Disk")
        .def(py::init([](const Triple& center, double radius) { return Disk(vector(center), radius); }),
             py::arg("center"), py::arg("radius"));
    py::class_<Ellipse, Within>(module, "Ellipse")
        .def(py::init([](const Triple& center, double first, double second, const Triple& direction) {
                 return Ellipse(vector(center), first, second, vector(direction));
             }),
             py::arg("center"), py::arg("first"), py::arg("second"), py::arg("direction"));
    py::class_<Polygon, Within>(module, "Polygon")
        .def(py::init([](const std::vector<Triple>& corners) {
                 std::vector<Eigen::Vector3d> out;
                 out.reserve(corners.size());
                 for (const Triple& c : corners) out.push_back(vector(c));
                 return Polygon(std::move(out));
             }),
             py::arg("corners"));
    py::class_<HalfPlane, Within>(module, "HalfPlane")
        .def(py::init([](const Triple& origin, const Triple& direction) {
                 return HalfPlane(vector(origin), vector(direction));
             }),
             py::arg("origin"), py::arg("direction"));
    py::class_<CylinderPart, Within>(module, "CylinderPart")
        .def(py::init([](double low, double high, std::optional<std::tuple<double, double, Triple>> angles) {
                 if (!angles) return CylinderPart(low, high);
                 const auto& [start, end, zero] = *angles;
                 return CylinderPart(low, high, CylinderPart::Angles{start, end, vector(zero)});
             }),
             py::arg("low"), py::arg("high"), py::arg("angles"));
}

}  // namespace

void bind_tools(py::module_& module) {
    bind_base(module);
    bind_analytic_surfaces(module);
    bind_cad(module);
    bind_within(module);
}

}  // namespace femscalpel::bindings
