// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>

#include "arrays.h"
#include "bindings.h"
#include "fracture/stress_intensity.h"
#include "interruptible.h"

namespace py = pybind11;

namespace femscalpel::bindings {
namespace {

template <class Row>
py::array_t<double> rows_of(const std::vector<Row>& rows) {
    py::array_t<double> out({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
    double* to = out.mutable_data();
    for (const Row& row : rows) to = std::copy_n(&row[0], 3, to);
    return out;
}

/// The columns of femscalpel.StressIntensity, by name.
py::dict stress_intensity_of(const std::shared_ptr<Mesh>& mesh, const RealArray& displacements,
                             const std::string& front, double young, double poisson, bool plane_stress, double radius) {
    std::vector<Vec3> rows(static_cast<std::size_t>(displacements.size()) / 3);
    for (std::size_t v = 0; v < rows.size(); ++v) rows[v] = Vec3(displacements.data() + 3 * v);
    const StressIntensity k = interruptible([&] {
        return stress_intensity(*mesh, rows, front, Elasticity{young, poisson, plane_stress}, radius);
    });
    std::vector<std::int64_t> nodes;
    nodes.reserve(k.nodes.size());
    for (const Index v : k.nodes) nodes.push_back(mesh->node_ids[v]);
    py::dict out;
    out["nodes"] = copied<std::int64_t>(nodes);
    out["front"] = copied<int>(k.front);
    out["s"] = copied<double>(k.s);
    out["points"] = rows_of(k.points);
    out["k"] = rows_of(k.k);
    out["k_inside"] = rows_of(k.k_inside);
    out["k_lips"] = rows_of(k.k_lips);
    out["G"] = copied<double>(k.g);
    out["radius"] = k.radius;
    out["edge"] = k.edge;
    out["warnings"] = k.warnings;
    return out;
}

}  // namespace

void bind_fracture(py::module_& module) {
    module.def("stress_intensity", &stress_intensity_of, py::arg("mesh"), py::arg("displacements"), py::arg("front"),
               py::arg("young"), py::arg("poisson"), py::arg("plane_stress"), py::arg("radius"));
}

}  // namespace femscalpel::bindings
