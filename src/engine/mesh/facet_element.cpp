// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/facet_element.h"

#include <span>

namespace femscalpel {
namespace {

/// Node in the middle of a face of VTK's HEXA27 or PENTA18, by CalculiX's face number minus one.
constexpr std::int8_t hexahedron27_face_node[] = {24, 25, 22, 21, 23, 20};
constexpr std::int8_t wedge18_face_node[] = {-1, -1, 15, 16, 17};

}  // namespace

FacetElement facet_element(const Mesh& mesh, const Facet& facet) {
    const CellTraits& t = traits(facet.type);
    const std::span<const Index> nodes = mesh.block(facet.type).nodes(facet.cell);
    FacetElement out;
    const auto push = [&](int local) {
        out.nodes[static_cast<std::size_t>(out.size++)] = nodes[static_cast<std::size_t>(local)];
    };
    const auto push_middle = [&](int a, int b) {
        for (std::size_t e = 0; e < t.edges.size(); ++e)
            if ((t.edges[e][0] == a && t.edges[e][1] == b) || (t.edges[e][0] == b && t.edges[e][1] == a))
                return push(t.corners + static_cast<int>(e));
    };
    if (t.dimension == 2 && facet.face > 2) {
        const auto& edge = t.edges[static_cast<std::size_t>(facet.face) - 3];
        out.type = t.quadratic ? CellType::line3 : CellType::line;
        push(edge[0]);
        push(edge[1]);
        if (t.quadratic) push_middle(edge[0], edge[1]);
        return out;
    }

    // The corners, in the order that turns the normal outwards: CellTraits::faces turn it inwards.
    std::array<int, 4> corners{};
    int count = 0;
    int centre = -1;
    if (t.dimension == 3) {
        const auto& face = t.faces[static_cast<std::size_t>(facet.face) - 1];
        while (count < 4 && face[static_cast<std::size_t>(count)] >= 0) ++count;
        for (int k = 0; k < count; ++k)
            corners[static_cast<std::size_t>(k)] = int{face[static_cast<std::size_t>((count - k) % count)]};
        if (facet.type == CellType::hexahedron27) centre = hexahedron27_face_node[facet.face - 1];
        if (facet.type == CellType::wedge18) centre = wedge18_face_node[facet.face - 1];
    } else {
        count = t.corners;
        const bool turn = facet.face == 1;
        for (int k = 0; k < count; ++k) corners[static_cast<std::size_t>(k)] = turn ? (count - k) % count : k;
        if (t.nodes == 2 * count + 1) centre = 2 * count;
    }
    for (int k = 0; k < count; ++k) push(corners[static_cast<std::size_t>(k)]);
    if (t.quadratic)
        for (int k = 0; k < count; ++k)
            push_middle(corners[static_cast<std::size_t>(k)], corners[static_cast<std::size_t>((k + 1) % count)]);
    if (centre >= 0) push(centre);
    for (CellType type : {CellType::triangle, CellType::triangle6, CellType::triangle7, CellType::quad, CellType::quad8,
                          CellType::quad9})
        if (traits(type).corners == count && traits(type).nodes == out.size) out.type = type;
    return out;
}

}  // namespace femscalpel
