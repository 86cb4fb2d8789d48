// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <unordered_map>

#include "mesh/mesh.h"

namespace femscalpel {

/// Key of an edge between two nodes of a mesh, in either order.
std::uint64_t mesh_edge_key(Index a, Index b);

/// The mid-side nodes of a mesh by the keys of their edges, for the edges that `wanted(a, b)` takes.
std::unordered_map<std::uint64_t, Index> middles_of(const Mesh& mesh, auto wanted) {
    std::unordered_map<std::uint64_t, Index> out;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (!t.quadratic) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            for (std::size_t k = 0; k < t.edges.size(); ++k)
                if (const Index i = n[t.edges[k][0]], j = n[t.edges[k][1]]; wanted(i, j))
                    out.emplace(mesh_edge_key(i, j), n[t.corners + k]);
        }
    }
    return out;
}

/// All of them.
inline std::unordered_map<std::uint64_t, Index> middles_of(const Mesh& mesh) {
    return middles_of(mesh, [](Index, Index) { return true; });
}

}  // namespace femscalpel
