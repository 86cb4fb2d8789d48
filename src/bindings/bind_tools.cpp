// SPDX-License-Identifier: LGPL-2.1-or-later
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
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

Eigen::Vector3d to_engine(const Triple& t) { return vector(t); }
double to_engine(double x) { return x; }
Triple to_python(const Eigen::Vector3d& v) { return triple(v); }
double to_python(double x) { return x; }

/// A parameter of a tool: its name, and the attribute that gives it back.
template <class T, class Value>
struct Parameter {
    using Given = std::conditional_t<std::is_same_v<Value, double>, double, Triple>;
    const char* name;
    std::string attribute;
    Value (T::*get)() const;
};

/// A parameter that the tool keeps as it is given: a point or a number.
template <class T, class Value>
Parameter<T, Value> given(const char* name, Value (T::*get)() const) {
    return {name, name, get};
}

/// A direction, of which the tool keeps the unit vector.
template <class T, class Value>
Parameter<T, Value> direction(const char* name, Value (T::*get)() const) {
    return {name, std::string("unit_") + name, get};
}

/// Binds a tool that is made from `parameters`, in this order. What they are for is said by the package, in tools.py.
template <class T, class... Parameters>
py::class_<T, Tool> bind_tool(py::module_& module, const char* name, const Parameters&... parameters) {
    py::class_<T, Tool> out(module, name);
    out.def(py::init([](const typename Parameters::Given&... values) { return T(to_engine(values)...); }),
            py::arg(parameters.name)...);
    (out.def_property_readonly(parameters.attribute.c_str(),
                               [get = parameters.get](const T& tool) { return to_python((tool.*get)()); }),
     ...);
    return out;
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
    bind_tool<Plane>(module, "Plane", given("origin", &Plane::origin), direction("normal", &Plane::unit_normal));
    bind_tool<Cylinder>(module, "Cylinder", given("origin", &Cylinder::origin), direction("axis", &Cylinder::unit_axis),
                        given("radius", &Cylinder::radius));
    bind_tool<Sphere>(module, "Sphere", given("center", &Sphere::center), given("radius", &Sphere::radius));
    bind_tool<Torus>(module, "Torus", given("center", &Torus::center), direction("axis", &Torus::unit_axis),
                     given("major_radius", &Torus::major_radius), given("minor_radius", &Torus::minor_radius));
    bind_tool<Cone>(module, "Cone", given("origin", &Cone::origin), direction("axis", &Cone::unit_axis),
                    given("radius", &Cone::radius), given("half_angle", &Cone::half_angle))
        .def_property_readonly("apex", [](const Cone& cone) { return triple(cone.apex()); });
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
