// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <tuple>

#include "arrays.h"
#include "bindings.h"
#include "deck/card_places.h"
#include "deck/solver_input.h"
#include "interruptible.h"
#include "mesh/quality.h"

namespace py = pybind11;

namespace femscalpel::bindings {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "points are viewed as an (n, 3) array");

using CellArrays = std::tuple<std::string, IndexArray, IndexArray>;    // type name, (m, k) nodes, (m,) numbers
using GroupArrays = std::tuple<std::string, std::string, IndexArray>;  // name, kind, numbers

GroupKind kind_from_name(const std::string& name) {
    for (GroupKind kind : {GroupKind::node, GroupKind::element, GroupKind::facet})
        if (to_string(kind) == name) return kind;
    throw Error("unknown group kind '" + name + "': it must be 'node', 'element' or 'facet'");
}

/// Numbers as Python gives them: (n,) for nodes and elements, (n, 2) for facets.
GroupMembers members_from(GroupKind kind, const std::string& name, const IndexArray& ids) {
    GroupMembers out;
    out.kind = kind;
    if (kind != GroupKind::facet) {
        if (ids.ndim() != 1) throw Error("group '" + name + "': ids must be a one-dimensional array of numbers");
        out.ids = to_vector(ids);
        return out;
    }
    if (ids.size() == 0) return out;
    if (ids.ndim() != 2 || ids.shape(1) != 2)
        throw Error("facet group '" + name +
                    "': ids must be an array of shape (n, 2), element number and local face number");
    for (py::ssize_t i = 0; i < ids.shape(0); ++i) {
        out.ids.push_back(ids.at(i, 0));
        out.faces.push_back(ids.at(i, 1));
    }
    return out;
}

std::shared_ptr<Mesh> make_mesh(const RealArray& points, const IndexArray& node_ids,
                                const std::vector<CellArrays>& cells, const std::vector<GroupArrays>& groups) {
    auto mesh = std::make_shared<Mesh>();
    if (points.ndim() != 2 || points.shape(1) != 3) throw Error("points must have the shape (n, 3)");
    const auto n = static_cast<std::size_t>(points.shape(0));
    mesh->points.resize(n);
    for (std::size_t i = 0; i < n; ++i) mesh->points[i] = Eigen::Map<const Vec3>(points.data() + 3 * i);
    mesh->node_ids = to_vector(node_ids);
    mesh->node_families.assign(n, 0);
    for (const auto& [type_name, nodes, ids] : cells) {
        const CellTraits& type = traits(cell_type_from_name(type_name));
        if (nodes.ndim() != 2 || nodes.shape(1) != type.nodes)
            throw Error("cells['" + type_name + "'] must have the shape (m, " + std::to_string(type.nodes) + ")");
        CellBlock& block = mesh->block(type.type);
        block.connectivity = to_vector(nodes);
        block.ids = to_vector(ids);
        block.families.assign(block.ids.size(), 0);
    }
    interruptible([&] { mesh->validate(); });
    std::vector<GroupMembers> members;
    for (const auto& [name, kind, ids] : groups) {
        mesh->add_group(name, kind_from_name(kind));
        members.push_back(members_from(kind_from_name(kind), name, ids));
    }
    if (!members.empty()) interruptible([&] { assign_groups(*mesh, members); });
    return mesh;
}

py::dict cells(const py::object& self) {
    const Mesh& mesh = self.cast<const Mesh&>();
    py::dict out;
    for (const CellBlock& b : mesh.blocks())
        if (b.size() > 0)
            out[py::str(std::string(traits(b.type).name))] =
                view(b.connectivity.data(), {b.size(), traits(b.type).nodes}, self);
    return out;
}

py::dict cell_ids(const py::object& self) {
    const Mesh& mesh = self.cast<const Mesh&>();
    py::dict out;
    for (const CellBlock& b : mesh.blocks())
        if (b.size() > 0) out[py::str(std::string(traits(b.type).name))] = view(b.ids.data(), {b.size()}, self);
    return out;
}

void move_nodes(Mesh& mesh, const py::array_t<double, py::array::c_style>& points) {
    if (points.ndim() != 2 || points.shape(0) != mesh.node_count() || points.shape(1) != 3)
        throw Error("points must have the shape (" + std::to_string(mesh.node_count()) + ", 3)", "points");
    for (Index i = 0; i < mesh.node_count(); ++i)
        mesh.points[static_cast<std::size_t>(i)] = Vec3(points.at(i, 0), points.at(i, 1), points.at(i, 2));
}

using Range = std::tuple<Index, Index>;
using InstanceEntry = std::tuple<std::string, std::string, Index, Range, Range>;

/// Name, part, offset, first and last node and element.
std::vector<InstanceEntry> instances(const Mesh& mesh) {
    std::vector<InstanceEntry> out;
    if (const SolverInput* input = solver_input(mesh))
        for (const DeckInstance& i : input->instances())
            out.emplace_back(i.name, i.part, i.offset, Range{i.nodes[0], i.nodes[1]},
                             Range{i.elements[0], i.elements[1]});
    return out;
}

using PlaceEntry = std::tuple<Index, Index, std::string, bool>;

/// First line, number of lines, file and whether carried, of the pieces of each card.
std::vector<std::vector<PlaceEntry>> deck_places(const Mesh& mesh) {
    std::vector<std::vector<PlaceEntry>> out;
    if (const SolverInput* input = solver_input(mesh))
        for (const auto& lines : card_places(*input)) {
            auto& entries = out.emplace_back();
            for (const CardLines& l : lines) entries.emplace_back(l.first, l.count, l.file, l.carried);
        }
    return out;
}

void set_deck_places(Mesh& mesh, const std::vector<std::vector<PlaceEntry>>& places) {
    const SolverInput* input = solver_input(mesh);
    if (!input) return;
    std::vector<std::vector<CardLines>> lines;
    for (const auto& entries : places) {
        auto& of_card = lines.emplace_back();
        for (const auto& [first, count, file, carried] : entries) of_card.push_back({first, count, file, carried});
    }
    const auto deck = std::make_shared<SolverInput>(*input);
    set_card_places(*deck, lines);
    mesh.companion = deck;
}

}  // namespace

GroupIndex require_group(const Mesh& mesh, const std::string& name, const std::string& kind) {
    const auto group = mesh.find_group(name, kind_from_name(kind));
    if (!group) throw Error("the mesh has no " + kind + " group '" + name + "'");
    return *group;
}

py::array_t<std::int64_t> to_array(const GroupMembers& members) {
    if (members.kind != GroupKind::facet) return copied<std::int64_t>(members.ids);
    py::array_t<std::int64_t> out({static_cast<py::ssize_t>(members.ids.size()), py::ssize_t{2}});
    auto a = out.mutable_unchecked<2>();
    for (py::ssize_t i = 0; i < a.shape(0); ++i) {
        a(i, 0) = members.ids[static_cast<std::size_t>(i)];
        a(i, 1) = members.faces[static_cast<std::size_t>(i)];
    }
    return out;
}

namespace {

using MeshClass = py::class_<Mesh, std::shared_ptr<Mesh>>;

void bind_properties(MeshClass& mesh) {
    mesh.def(py::init(&make_mesh), py::arg("points"), py::arg("node_ids"), py::arg("cells"), py::arg("groups"))
        .def_property_readonly("points",
                               [](const py::object& self) {
                                   const Mesh& mesh = self.cast<const Mesh&>();
                                   const double* data = mesh.points.empty() ? nullptr : mesh.points.front().data();
                                   return view(data, {mesh.node_count(), 3}, self);
                               })
        .def("move_nodes", &move_nodes, py::arg("points"))
        .def_property_readonly("node_ids",
                               [](const py::object& self) {
                                   const Mesh& mesh = self.cast<const Mesh&>();
                                   return view(mesh.node_ids.data(), {mesh.node_count()}, self);
                               })
        .def_property_readonly("cells", &cells)
        .def_property_readonly("cell_ids", &cell_ids)
        .def_readwrite("name", &Mesh::name)
        .def_readwrite("unit", &Mesh::unit)
        .def_property_readonly("dimension", &Mesh::dimension)
        .def_property_readonly("node_count", &Mesh::node_count)
        .def_property_readonly("cell_count", &Mesh::cell_count)
        .def_property_readonly("has_solver_input", [](const Mesh& mesh) { return solver_input(mesh) != nullptr; })
        .def("instances", &instances)
        .def_readonly("remarks", &Mesh::remarks)
        .def("deck_places", &deck_places)
        .def("set_deck_places", &set_deck_places, py::arg("places"))
        .def("input_warnings", [](const Mesh& mesh) {
            const SolverInput* input = solver_input(mesh);
            std::vector<std::string> out = input ? input->warnings() : std::vector<std::string>{};
            out.insert(out.end(), mesh.remarks.begin(), mesh.remarks.end());
            return out;
        });
}

void bind_functions(MeshClass& mesh) {
    mesh.def("mean_ratios",
             [](const Mesh& mesh) {
                 py::dict out;
                 for (const CellBlock& b : mesh.blocks())
                     if (b.size() > 0)
                         out[py::str(std::string(traits(b.type).name))] =
                             copied<double>(interruptible([&] { return mean_ratios(mesh, b.type); }));
                 return out;
             })
        .def("measures",
             [](const Mesh& mesh) {
                 py::dict out;
                 for (const CellBlock& b : mesh.blocks()) {
                     if (b.size() == 0) continue;
                     const std::vector<double> values = interruptible([&] {
                         std::vector<double> measured;
                         SparseCheck check;
                         for (Index c = 0; c < b.size(); ++c, check())
                             measured.push_back(cell_measure(mesh, b.type, c));
                         return measured;
                     });
                     out[py::str(std::string(traits(b.type).name))] = copied<double>(values);
                 }
                 return out;
             })
        .def(
            "copy", [](const Mesh& mesh) { return std::make_shared<Mesh>(mesh); },
            py::call_guard<py::gil_scoped_release>())
        .def("validate", [](const Mesh& mesh) { interruptible([&] { mesh.validate(); }); });
}

void bind_groups_of(MeshClass& mesh) {
    mesh.def("groups",
             [](const Mesh& mesh) {
                 std::vector<std::pair<std::string, std::string>> out;
                 for (const Group& g : mesh.groups)
                     if (!g.hidden) out.emplace_back(g.name, to_string(g.kind));
                 return out;
             })
        .def(
            "group_ids",
            [](const Mesh& mesh, const std::string& name, const std::string& kind) {
                const GroupIndex group = require_group(mesh, name, kind);
                return to_array(interruptible([&] { return group_members(mesh, group); }));
            },
            py::arg("name"), py::arg("kind"))
        .def(
            "add_group",
            [](Mesh& mesh, const std::string& name, const std::string& kind, const IndexArray& ids) {
                const GroupMembers members = members_from(kind_from_name(kind), name, ids);
                const GroupIndex group = mesh.add_group(name, members.kind);
                try {
                    set_group_members(mesh, group, members);
                } catch (...) {
                    remove_group(mesh, group);
                    throw;
                }
            },
            py::arg("name"), py::arg("kind"), py::arg("ids"))
        .def(
            "set_group_ids",
            [](Mesh& mesh, const std::string& name, const std::string& kind, const IndexArray& ids) {
                set_group_members(mesh, require_group(mesh, name, kind), members_from(kind_from_name(kind), name, ids));
            },
            py::arg("name"), py::arg("kind"), py::arg("ids"))
        .def(
            "remove_group",
            [](Mesh& mesh, const std::string& name, const std::string& kind) {
                remove_group(mesh, require_group(mesh, name, kind));
            },
            py::arg("name"), py::arg("kind"))
        .def(
            "rename_group",
            [](Mesh& mesh, const std::string& old_name, const std::string& new_name, const std::string& kind) {
                rename_group(mesh, require_group(mesh, old_name, kind), new_name);
            },
            py::arg("old_name"), py::arg("new_name"), py::arg("kind"));
}

}  // namespace

void bind_mesh(py::module_& module) {
    module.def(
        "cell_types",
        [] {
            py::dict out;
            for (const CellTraits& t : all_cell_types())
                out[py::str(std::string(t.name))] = py::make_tuple(t.dimension, t.nodes, t.corners);
            return out;
        },
        "Element types by name: (dimension, nodes, corners).");

    MeshClass mesh(module, "Mesh");
    bind_properties(mesh);
    bind_functions(mesh);
    bind_groups_of(mesh);
    bind_fields(mesh);
}

}  // namespace femscalpel::bindings
