// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "groups/elementary_groups.h"
#include "groups/virtual_boundary.h"
#include "interruptible.h"
#include "mesh/pieces.h"

namespace py = pybind11;

namespace femscalpel::bindings {
namespace {

/// An (n, width) array, filled by put(row, column).
template <class Put>
py::array_t<std::int64_t> table(std::size_t rows, std::size_t width, Put put) {
    py::array_t<std::int64_t> out({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(width)});
    auto a = out.mutable_unchecked<2>();
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < width; ++k) a(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k)) = put(i, k);
    return out;
}

/// Element numbers; 0 where there is no element.
py::array_t<std::int64_t> numbers(const Mesh& mesh, const std::vector<CellRef>& cells) {
    std::vector<std::int64_t> ids;
    ids.reserve(cells.size());
    for (const CellRef& c : cells)
        ids.push_back(c.cell < 0 ? 0 : mesh.block(c.type).ids[static_cast<std::size_t>(c.cell)]);
    return copied<std::int64_t>(ids);
}

py::dict part(const Mesh& mesh, const BoundaryPart& p) {
    std::vector<std::int64_t> nodes;
    nodes.reserve(p.nodes.size());
    for (const Index n : p.nodes) nodes.push_back(mesh.node_ids[static_cast<std::size_t>(n)]);
    std::vector<std::array<Index, 4>> faces[2];  // triangles, quadrangles
    std::vector<CellRef> elements[2];
    for (std::size_t i = 0; i < p.faces.size(); ++i) {
        const bool quad = p.faces[i][3] >= 0;
        faces[quad].push_back(p.faces[i]);
        elements[quad].push_back(p.face_elements[i]);
    }
    const auto id = [&](Index n) { return mesh.node_ids[static_cast<std::size_t>(n)]; };
    py::dict out;
    out["nodes"] = copied<std::int64_t>(nodes);
    out["edges"] = table(p.edges.size(), 2, [&](std::size_t i, std::size_t k) { return id(p.edges[i][k]); });
    out["triangles"] = table(faces[0].size(), 3, [&](std::size_t i, std::size_t k) { return id(faces[0][i][k]); });
    out["quads"] = table(faces[1].size(), 4, [&](std::size_t i, std::size_t k) { return id(faces[1][i][k]); });
    out["edge_elements"] = numbers(mesh, p.edge_elements);
    out["triangle_elements"] = numbers(mesh, elements[0]);
    out["quad_elements"] = numbers(mesh, elements[1]);
    return out;
}

py::tuple boundary(const Mesh& mesh, const VirtualBoundary& b) {
    return py::make_tuple(part(mesh, b.bounding), part(mesh, b.linking), part(mesh, b.isolated),
                          numbers(mesh, b.enclosed));
}

py::list boundaries(const Mesh& mesh, const std::vector<GroupIndex>& groups) {
    const std::vector<VirtualBoundary> found = interruptible([&] {
        const VirtualBoundaryFinder finder(mesh);
        std::vector<VirtualBoundary> all;
        all.reserve(groups.size());
        for (const GroupIndex g : groups) all.push_back(finder.find(g));
        return all;
    });
    py::list out;
    for (const VirtualBoundary& b : found) out.append(boundary(mesh, b));
    return out;
}

/// Fields of each piece. `changed` may be null.
py::list pieces_of(const Mesh& mesh, const Mesh* changed, const IndexArray& gone) {
    const std::vector<std::int64_t> gone_ids = to_vector(gone);
    const std::vector<Piece> found =
        interruptible([&] { return changed ? find_pieces(mesh, *changed, gone_ids) : find_pieces(mesh); });
    py::list out;
    for (const Piece& piece : found) {
        py::list groups;
        for (const GroupIndex g : piece.groups) {
            const Group& group = mesh.groups[static_cast<std::size_t>(g)];
            groups.append(py::make_tuple(group.name, std::string(to_string(group.kind))));
        }
        py::dict fields;
        fields["dimension"] = piece.dimension;
        fields["measure"] = piece.measure;
        fields["place"] = py::make_tuple(piece.place.x(), piece.place.y(), piece.place.z());
        fields["elements"] = copied<std::int64_t>(piece.elements);
        fields["nodes"] = copied<std::int64_t>(piece.nodes);
        fields["groups"] = groups;
        out.append(fields);
    }
    return out;
}

}  // namespace

void bind_groups(py::module_& module) {
    module.def("pieces", &pieces_of, py::arg("mesh"), py::arg("changed"), py::arg("gone"));
    module.def(
        "elementary_groups",
        [](const Mesh& mesh) {
            const std::vector<ElementaryGroup> found = interruptible([&] { return elementary_groups(mesh); });
            py::list out;
            for (const ElementaryGroup& g : found) {
                py::tuple names(g.groups.size());
                for (std::size_t i = 0; i < g.groups.size(); ++i)
                    names[i] = mesh.groups[static_cast<std::size_t>(g.groups[i])].name;
                out.append(py::make_tuple(std::string(to_string(g.kind)), g.dimension, names, to_array(g.members)));
            }
            return out;
        },
        py::arg("mesh"));
    module.def(
        "virtual_boundaries",
        [](const Mesh& mesh, const std::vector<std::pair<std::string, std::string>>& groups) {
            std::vector<GroupIndex> indices;
            indices.reserve(groups.size());
            for (const auto& [name, kind] : groups) indices.push_back(require_group(mesh, name, kind));
            return boundaries(mesh, indices);
        },
        py::arg("mesh"), py::arg("groups"));
}

}  // namespace femscalpel::bindings
