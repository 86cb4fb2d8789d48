// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/locate.h"

#include <cmath>
#include <sstream>

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

Location locate(const Mesh& mesh, const Tool& tool, int levels, const Adjacency* adjacency) {
    Location out;
    out.distance.resize(mesh.points.size());
    out.level.assign(mesh.points.size(), -1);
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        out.distance[n] = tool.distance(mesh.points[n]);
        low = low.cwiseMin(mesh.points[n]);
        high = high.cwiseMax(mesh.points[n]);
        if (std::abs(out.distance[n]) < std::abs(nearest)) nearest = out.distance[n];
    }
    if (mesh.points.empty()) throw ToolError("the mesh is empty: there is nothing to cut");
    out.tolerance = 1e-10 * (high - low).norm();

    bool touched = false;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < 2) continue;
        const Index* n = b.connectivity.data();
        for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
            double smallest = out.distance[n[0]], largest = smallest;
            for (int k = 1; k < t.corners; ++k) {
                smallest = std::min(smallest, out.distance[n[k]]);
                largest = std::max(largest, out.distance[n[k]]);
            }
            if (smallest > out.tolerance || largest < -out.tolerance) continue;
            const bool crossed = smallest < -out.tolerance && largest > out.tolerance;
            if (crossed) ++out.crossed;
            for (int k = 0; k < t.corners; ++k)
                if (crossed || std::abs(out.distance[n[k]]) <= out.tolerance) out.level[n[k]] = 0;
            touched = true;
        }
    }
    if (!touched) {
        std::ostringstream message;
        message << "the " << tool.kind() << " misses the mesh: the whole mesh lies on its " << (nearest > 0 ? "positive" : "negative")
                << " side, the nearest node at distance " << std::abs(nearest) << ". Move the " << tool.kind() << " or turn it";
        throw ToolError(message.str());
    }

    spread_levels(mesh, out.level, levels, adjacency);
    return out;
}

void spread_levels(const Mesh& mesh, std::vector<std::int8_t>& levels, int count, const Adjacency* adjacency) {
    std::vector<Index> front, next;
    if (adjacency)
        for (std::size_t n = 0; n < levels.size(); ++n)
            if (levels[n] == 0) front.push_back(static_cast<Index>(n));
    for (int level = 1; level <= count; ++level) {
        const auto reach = [&](CellType type, const Index* n) {
            const int corners = traits(type).corners;
            bool near = false;
            for (int k = 0; k < corners; ++k) near = near || levels[n[k]] == level - 1;
            if (!near) return;
            for (int k = 0; k < corners; ++k)
                if (levels[n[k]] < 0) {
                    levels[n[k]] = static_cast<std::int8_t>(level);
                    if (adjacency) next.push_back(n[k]);
                }
        };
        if (adjacency) {
            next.clear();
            for (Index n : front)
                adjacency->around(n, [&](CellType type, Index cell) {
                    if (traits(type).dimension >= 2) reach(type, mesh.block(type).nodes(cell).data());
                });
            front.swap(next);
        } else {
            for (const CellBlock& b : mesh.blocks()) {
                const CellTraits& t = traits(b.type);
                if (t.dimension < 2) continue;
                const Index* n = b.connectivity.data();
                for (Index c = 0; c < b.size(); ++c, n += t.nodes) reach(b.type, n);
            }
        }
    }
}

}  // namespace femscalpel
