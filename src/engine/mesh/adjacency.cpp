// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/adjacency.h"

namespace femscalpel {

Adjacency::Adjacency(const Mesh& mesh) : start_(mesh.points.size() + 1, 0) {
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        for (Index c = 0; c < b.size(); ++c)
            for (int k = 0; k < t.corners; ++k) ++start_[b.connectivity[static_cast<std::size_t>(c) * t.nodes + k] + 1];
    }
    for (std::size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
    cells_.resize(static_cast<std::size_t>(start_.back()));
    std::vector<Index> fill(start_.begin(), start_.end() - 1);
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        for (Index c = 0; c < b.size(); ++c)
            for (int k = 0; k < t.corners; ++k)
                cells_[fill[b.connectivity[static_cast<std::size_t>(c) * t.nodes + k]]++] = c * cell_type_count + static_cast<Index>(b.type);
    }
}

}  // namespace femscalpel
