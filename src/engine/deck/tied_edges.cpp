// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/tied_edges.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>

#include "cancel.h"
#include "deck/solver_input.h"
#include "deck/solver_sets.h"
#include "mesh/middles.h"

namespace femscalpel {
namespace {

using Triangle = std::array<Index, 3>;

Triangle triangle(Index a, Index b, Index c) {
    Triangle t{a, b, c};
    std::ranges::sort(t);
    return t;
}

/// Ends and mid-side node.
using Edge = std::array<Index, 3>;

/// In the order of the mid-side nodes, each once.
std::vector<TiedEdge> by_number(const Mesh& mesh, const std::map<Index, Edge>& edges) {
    std::vector<TiedEdge> out;
    out.reserve(edges.size());
    for (const auto& [middle, edge] : edges)
        out.push_back({mesh.node_ids[middle], mesh.node_ids[edge[0]], mesh.node_ids[edge[1]]});
    return out;
}

/// The mid-side nodes of solids by the keys of their edges, but for ends that are one node.
std::unordered_map<std::uint64_t, Edge> edges_of_second_order(const Mesh& mesh) {
    std::unordered_map<std::uint64_t, Edge> out;
    SparseCheck check(1 << 12);
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (!t.quadratic || t.dimension < 3) continue;
        for (Index c = 0; c < b.size(); ++c, check()) {
            const auto n = b.nodes(c);
            for (std::size_t k = 0; k < t.edges.size(); ++k)
                if (const Index i = n[t.edges[k][0]], j = n[t.edges[k][1]]; i != j)
                    out.emplace(mesh_edge_key(i, j), Edge{i, j, n[static_cast<std::size_t>(t.corners) + k]});
        }
    }
    return out;
}

}  // namespace

std::vector<TiedEdge> edges_of_pyramids(const Mesh& mesh) {
    std::map<Triangle, Edge> sides;
    const CellBlock& pyramids = mesh.block(CellType::pyramid13);
    if (pyramids.size() == 0) return {};
    for (Index c = 0; c < pyramids.size(); ++c) {
        const auto n = pyramids.nodes(c);
        for (int k = 0; k < 4; ++k) {
            const Index a = n[k], b = n[(k + 1) % 4];
            sides.emplace(triangle(a, b, n[4]), Edge{a, b, n[5 + k]});
        }
    }
    std::map<Index, Edge> out;
    SparseCheck check(1 << 12);
    for (const CellType type : {CellType::tetra10, CellType::wedge15}) {
        const CellBlock& b = mesh.block(type);
        for (Index c = 0; c < b.size(); ++c, check()) {
            const auto n = b.nodes(c);
            for (const auto& f : traits(type).faces) {
                if (f[3] >= 0) continue;
                const auto side = sides.find(triangle(n[f[0]], n[f[1]], n[f[2]]));
                if (side != sides.end()) out.emplace(side->second[2], side->second);
            }
        }
    }
    return by_number(mesh, out);
}

std::vector<TiedEdge> edges_between_orders(const Mesh& mesh) {
    const SolverInput* const deck = solver_input(mesh);
    if (!deck || !deck->ties_orders()) return {};
    const std::unordered_map<std::uint64_t, Edge> second = edges_of_second_order(mesh);
    if (second.empty()) return {};
    const std::vector<char> whole = families_of_whole_elements(mesh);
    std::map<Index, Edge> out;
    SparseCheck check(1 << 12);
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.quadratic || t.dimension == 0) continue;
        for (Index c = 0; c < b.size(); ++c, check()) {
            if (t.dimension < 3 && (whole.empty() || !whole[b.families[c]])) continue;
            const auto n = b.nodes(c);
            for (const auto& e : t.edges)
                if (const auto edge = second.find(mesh_edge_key(n[e[0]], n[e[1]])); edge != second.end())
                    out.emplace(edge->second[2], edge->second);
        }
    }
    return by_number(mesh, out);
}

}  // namespace femscalpel
