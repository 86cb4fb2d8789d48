// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Elements around each node, of all types, by their corners. Linear time and memory.
class Adjacency {
public:
    explicit Adjacency(const Mesh& mesh);

    /// Calls visit(type, cell) for the elements around a node, in the mesh's order.
    template <class Visit>
    void around(Index node, Visit visit) const {
        for (Index k = start_[node]; k < start_[node + 1]; ++k) {
            const std::int64_t v = cells_[k];
            visit(static_cast<CellType>(v % cell_type_count), static_cast<Index>(v / cell_type_count));
        }
    }

private:
    std::vector<Index> start_;
    std::vector<std::int64_t> cells_;
};

/// Indices of elements, ascending, by type.
using CellLists = std::array<std::vector<Index>, cell_type_count>;

/// The elements with a corner node where level[node] >= 0. One pass over the elements, unless their `adjacency` is
/// given.
CellLists elements_near(const Mesh& mesh, const std::vector<std::int8_t>& level, const Adjacency* adjacency);

}  // namespace femscalpel
