// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/adjacency.h"

#include "cancel.h"

namespace femscalpel {

Adjacency::Adjacency(const Mesh& mesh) : start_(mesh.points.size() + 1, 0) {
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        check_cancelled();
        for (Index c = 0; c < b.size(); ++c)
            for (int k = 0; k < t.corners; ++k) ++start_[b.connectivity[static_cast<std::size_t>(c) * t.nodes + k] + 1];
    }
    for (std::size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
    cells_.resize(static_cast<std::size_t>(start_.back()));
    std::vector<Index> fill(start_.begin(), start_.end() - 1);
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        SparseCheck check(1 << 16);
        for (Index c = 0; c < b.size(); ++c, check())
            for (int k = 0; k < t.corners; ++k)
                cells_[fill[b.connectivity[static_cast<std::size_t>(c) * t.nodes + k]]++] =
                    c * cell_type_count + static_cast<Index>(b.type);
    }
}

CellLists elements_near(const Mesh& mesh, const std::vector<std::int8_t>& level, const Adjacency* adjacency) {
    CellLists cells;
    if (!adjacency) {
        for (const CellBlock& block : mesh.blocks()) {
            const CellTraits& t = traits(block.type);
            std::vector<Index>& chosen = cells[static_cast<int>(block.type)];
            const Index count = block.size();
            const Index* n = block.connectivity.data();
            for (Index c = 0; c < count; ++c, n += t.nodes) {
                bool near = false;
                for (int k = 0; k < t.corners; ++k) near |= level[n[k]] >= 0;
                if (near) chosen.push_back(c);
            }
        }
        return cells;
    }
    // One bit per element puts them in order at next to no cost.
    std::array<std::vector<bool>, cell_type_count> near;
    for (const CellBlock& block : mesh.blocks())
        near[static_cast<int>(block.type)].resize(static_cast<std::size_t>(block.size()));
    for (std::size_t n = 0; n < level.size(); ++n)
        if (level[n] >= 0)
            adjacency->around(static_cast<Index>(n), [&](CellType type, Index cell) {
                near[static_cast<int>(type)][static_cast<std::size_t>(cell)] = true;
            });
    for (std::size_t type = 0; type < near.size(); ++type)
        for (std::size_t c = 0; c < near[type].size(); ++c)
            if (near[type][c]) cells[type].push_back(static_cast<Index>(c));
    return cells;
}

}  // namespace femscalpel
