// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/order.h"

#include <algorithm>
#include <unordered_map>

#include "mesh/band_mesh.h"
#include "mesh/middles.h"

namespace femscalpel {
namespace {

/// The type with the same corners and a node on each edge; the type itself if there is none.
CellType with_middles(CellType type) {
    for (const CellTraits& t : all_cell_types())
        if (t.linear == type && t.quadratic && t.nodes == t.corners + static_cast<int>(t.edges.size())) return t.type;
    return type;
}

/// Gives elements the type `type_of(type)` and the nodes `nodes_of(mesh, block, cell)`; facets and groups follow.
void retype(Mesh& mesh, auto type_of, auto nodes_of) {
    Mesh old = mesh;
    std::array<std::vector<Index>, cell_type_count> place;
    for (CellBlock& b : mesh.blocks()) b = CellBlock{b.type, {}, {}, {}};
    for (const CellBlock& b : old.blocks())
        for (Index c = 0; c < b.size(); ++c)
            place[static_cast<int>(b.type)].push_back(
                mesh.add_cell(type_of(b.type), nodes_of(old, b, c), b.ids[c], b.families[c]));
    for (Facet& f : mesh.facets) {
        f.cell = place[static_cast<int>(f.type)][f.cell];
        f.type = type_of(f.type);
    }
}

}  // namespace

std::uint64_t mesh_edge_key(Index a, Index b) { return edge_key(static_cast<int>(a), static_cast<int>(b)); }

bool is_second_order(const Mesh& mesh) {
    bool any = false;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (b.size() == 0 || t.dimension != mesh.dimension()) continue;
        if (!t.quadratic) return false;
        any = true;
    }
    return any;
}

Mesh to_second_order(const Mesh& mesh) {
    Mesh out = mesh;
    std::unordered_map<std::uint64_t, Index> middles = middles_of(mesh);
    Index number = mesh.largest_node_id();
    const auto middle = [&](Index a, Index b) {
        const auto [found, fresh] = middles.emplace(mesh_edge_key(a, b), out.node_count());
        if (!fresh) return found->second;
        std::vector<GroupIndex> both;
        const auto of_a = out.families.groups(out.node_families[a]), of_b = out.families.groups(out.node_families[b]);
        std::ranges::set_intersection(of_a, of_b, std::back_inserter(both));
        FamilyIndex family = 0;
        for (const GroupIndex g : both) family = out.families.with(family, g);
        return out.add_node((out.points[a] + out.points[b]) / 2, ++number, family);
    };
    retype(out, with_middles, [&](const Mesh&, const CellBlock& b, Index c) {
        const auto n = b.nodes(c);
        std::vector<Index> nodes(n.begin(), n.end());
        if (const CellType type = with_middles(b.type); type != b.type)
            for (const auto& e : traits(type).edges) nodes.push_back(middle(n[e[0]], n[e[1]]));
        return nodes;
    });
    return out;
}

Mesh to_first_order(const Mesh& mesh) {
    Mesh out = mesh;
    std::vector<char> is_corner(mesh.points.size(), 0), is_used(mesh.points.size(), 0);
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (std::size_t k = 0; k < n.size(); ++k)
                (k < static_cast<std::size_t>(traits(b.type).corners) ? is_corner : is_used)[n[k]] = 1;
        }
    std::vector<Index> place(mesh.points.size(), -1);
    out.points.clear();
    out.node_ids.clear();
    out.node_families.clear();
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (is_corner[n] || !is_used[n])
            place[n] = out.add_node(mesh.points[n], mesh.node_ids[n], mesh.node_families[n]);
    retype(
        out, [](CellType type) { return traits(type).linear; },
        [&](const Mesh&, const CellBlock& b, Index c) {
            std::vector<Index> nodes;
            for (const Index n : b.nodes(c).first(static_cast<std::size_t>(traits(b.type).corners)))
                nodes.push_back(place[n]);
            return nodes;
        });
    return out;
}

}  // namespace femscalpel
