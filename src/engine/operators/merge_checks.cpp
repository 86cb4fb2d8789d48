// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge_checks.h"

#include <algorithm>
#include <sstream>

#include "cutting/surface_line.h"
#include "error.h"
#include "mesh/surface.h"
#include "mesh/surface_tree.h"
#include "mesh/union_find.h"

namespace femscalpel {
namespace {

/// Whether a solid has a node of the other mesh inside, as they nowhere cross the whole of it.
bool is_inside(const Mesh& inner, const Mesh& solid) {
    if (solid.dimension() < 3) return false;
    const std::vector<SurfaceFace> skin = surface_near(solid, box_around(solid)),
                                   own = surface_near(inner, box_around(inner));
    if (skin.empty() || own.empty()) return false;
    return SurfaceTree(solid, skin).signed_distance(inner.points[own[0].nodes[0]]) < 0;
}

}  // namespace

void fail_apart(const Mesh& mesh, const Mesh& addition) {
    if (is_inside(addition, mesh))
        throw ToolError(
            "the addition lies inside the mesh, where there is material already: nowhere do their "
            "surfaces meet. Move the addition",
            "other");
    if (is_inside(mesh, addition))
        throw ToolError(
            "the addition swallows the mesh: all of it lies inside the addition. Move the addition, or "
            "make it hollow",
            "other");
    const Eigen::AlignedBox3d a = box_around(mesh), b = box_around(addition);
    std::ostringstream out;
    out << "the addition does not meet the mesh: nowhere do their surfaces cross, and no border of the one is on the "
           "other. The mesh reaches from "
        << point_text(a.min()) << " to " << point_text(a.max()) << ", the addition from " << point_text(b.min())
        << " to " << point_text(b.max()) << ". Move the addition, or give a larger tolerance";
    throw ToolError(out.str(), "other");
}

void check_pieces(const Mesh& mesh, const std::string& added, const std::vector<Index>& seam) {
    const GroupIndex group = *mesh.find_group(added, GroupKind::element);
    UnionFind pieces(mesh.node_count());
    std::vector<Index> one;  // a node of each element that has an extent
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            if (!mesh.families.contains(b.families[c], group)) continue;
            const auto n = b.nodes(c);
            for (std::size_t k = 1; k < n.size(); ++k) pieces.unite(n[0], n[k]);
            if (traits(b.type).dimension >= 2) one.push_back(n[0]);
        }
    std::vector<char> joined(mesh.points.size(), 0);
    for (const Index n : seam) joined[pieces.find(n)] = 1;
    const auto loose = std::ranges::find_if(one, [&](Index n) { return joined[pieces.find(n)] == 0; });
    if (loose != one.end())
        throw ToolError("a piece of the addition, at " + point_text(mesh.points[*loose]) +
                            ", does not meet the mesh and would be loose. Move it, leave it out, or give a larger "
                            "tolerance",
                        "other");
}

}  // namespace femscalpel
