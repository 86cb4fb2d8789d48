// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/order.h"

#include <algorithm>
#include <unordered_map>

#include "mesh/band_mesh.h"
#include "mesh/companion.h"
#include "mesh/middles.h"

namespace femscalpel {
namespace {

/// The type with the same corners and a node on each edge; the type itself if there is none.
CellType with_middles(CellType type) {
    for (const CellTraits& t : all_cell_types())
        if (t.linear == type && t.quadratic && t.nodes == t.corners + static_cast<int>(t.edges.size())) return t.type;
    return type;
}

/// Gives elements the type `type_of(type, cell)` and the nodes `nodes_of(mesh, block, cell)`; facets and groups follow.
/// Returns where elements are now.
std::array<std::vector<Index>, cell_type_count> retype(Mesh& mesh, auto type_of, auto nodes_of) {
    Mesh old = mesh;
    std::array<std::vector<Index>, cell_type_count> place;
    for (CellBlock& b : mesh.blocks()) b = CellBlock{b.type, {}, {}, {}};
    for (const CellBlock& b : old.blocks())
        for (Index c = 0; c < b.size(); ++c)
            place[static_cast<int>(b.type)].push_back(
                mesh.add_cell(type_of(b.type, c), nodes_of(old, b, c), b.ids[c], b.families[c]));
    for (Facet& f : mesh.facets) {
        const CellRef was{f.type, f.cell};
        f.cell = place[static_cast<int>(was.type)][was.cell];
        f.type = type_of(was.type, was.cell);
    }
    return place;
}

/// New mid-side nodes where there are none.
class Middles {
public:
    Middles(Mesh& mesh, Index number) : mesh_(mesh), known_(middles_of(mesh)), number_(number) {}

    Index at(Index a, Index b) {
        if (a == b) return a;  // of an element with a node twice
        const auto [found, fresh] = known_.emplace(mesh_edge_key(a, b), mesh_.node_count());
        if (!fresh) return found->second;
        std::vector<GroupIndex> both;
        const auto of_a = mesh_.families.groups(mesh_.node_families[a]),
                   of_b = mesh_.families.groups(mesh_.node_families[b]);
        std::ranges::set_intersection(of_a, of_b, std::back_inserter(both));
        FamilyIndex family = 0;
        for (const GroupIndex g : both) family = mesh_.families.with(family, g);
        made_.push_back({number_, mesh_.node_ids[a], mesh_.node_ids[b]});
        return mesh_.add_node((mesh_.points[a] + mesh_.points[b]) / 2, number_++, family);
    }

    std::vector<std::array<Index, 3>>& made() { return made_; }

private:
    Mesh& mesh_;
    std::unordered_map<std::uint64_t, Index> known_;
    Index number_;
    std::vector<std::array<Index, 3>> made_;
};

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
    std::array<std::vector<char>, cell_type_count> all;
    for (const CellBlock& b : mesh.blocks()) all[static_cast<int>(b.type)].assign(b.ids.size(), 1);
    const Index others = mesh.companion ? mesh.companion->largest_other_node() : 0;
    return to_second_order(mesh, all, std::max(mesh.largest_node_id(), others) + 1).mesh;
}

RaisedOrder to_second_order(const Mesh& mesh, const std::array<std::vector<char>, cell_type_count>& chosen,
                            Index number) {
    RaisedOrder out;
    out.mesh = mesh;
    Middles middles(out.mesh, number);
    const auto type_of = [&](CellType type, Index c) {
        return chosen[static_cast<int>(type)][static_cast<std::size_t>(c)] ? with_middles(type) : type;
    };
    const auto place = retype(out.mesh, type_of, [&](const Mesh&, const CellBlock& b, Index c) {
        const auto n = b.nodes(c);
        std::vector<Index> nodes(n.begin(), n.end());
        if (const CellType type = type_of(b.type, c); type != b.type)
            for (const auto& e : traits(type).edges) nodes.push_back(middles.at(n[e[0]], n[e[1]]));
        return nodes;
    });
    out.made = std::move(middles.made());
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const CellType type = type_of(b.type, c);
            if (type == b.type) continue;
            out.before.push_back({b.type, c});
            out.after.push_back({type, place[static_cast<int>(b.type)][static_cast<std::size_t>(c)]});
        }
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
        out, [](CellType type, Index) { return traits(type).linear; },
        [&](const Mesh&, const CellBlock& b, Index c) {
            std::vector<Index> nodes;
            for (const Index n : b.nodes(c).first(static_cast<std::size_t>(traits(b.type).corners)))
                nodes.push_back(place[n]);
            return nodes;
        });
    return out;
}

}  // namespace femscalpel
