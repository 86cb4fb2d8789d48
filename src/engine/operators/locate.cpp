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

namespace {

/// Longest edge of an element, by its corners.
double longest_edge(const Mesh& mesh, const CellTraits& t, const Index* n) {
    double longest = 0;
    for (int a = 0; a < t.corners; ++a)
        for (int b = 0; b < a; ++b) longest = std::max(longest, (mesh.points[n[a]] - mesh.points[n[b]]).squaredNorm());
    return std::sqrt(longest);
}

/// Marks the nodes of elements that one blade touches with level 0.
void touch(const Mesh& mesh, const Blade& blade, const std::vector<double>& distance, Location& out) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const double d : distance)
        if (std::abs(d) < std::abs(nearest)) nearest = d;
    bool touched = false, beyond = false;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < 2) continue;
        const Index* n = b.connectivity.data();
        for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
            double smallest = distance[n[0]], largest = smallest;
            for (int k = 1; k < t.corners; ++k) {
                smallest = std::min(smallest, distance[n[k]]);
                largest = std::max(largest, distance[n[k]]);
            }
            if (smallest > out.tolerance || largest < -out.tolerance) continue;
            if (blade.bound) {
                double bound = std::numeric_limits<double>::infinity();
                for (int k = 0; k < t.corners; ++k) bound = std::min(bound, blade.bound(mesh.points[n[k]]));
                if (bound > blade_margin * longest_edge(mesh, t, n)) {
                    beyond = true;
                    continue;
                }
            }
            const bool crossed = smallest < -out.tolerance && largest > out.tolerance;
            if (crossed) ++out.crossed;
            for (int k = 0; k < t.corners; ++k)
                if (crossed || std::abs(distance[n[k]]) <= out.tolerance) out.level[n[k]] = 0;
            touched = true;
        }
    }
    if (touched) return;
    std::ostringstream message;
    if (beyond) {
        message << "the " << blade.tool->kind() << " meets the mesh only outside the part of it that is to cut. Move that part into the material";
    } else {
        message << "the " << blade.tool->kind() << " misses the mesh: the whole mesh lies on its " << (nearest > 0 ? "positive" : "negative")
                << " side, the nearest node at distance " << std::abs(nearest) << ". Move the " << blade.tool->kind() << " or turn it";
    }
    throw ToolError(message.str());
}

}  // namespace

Location locate(const Mesh& mesh, std::span<const Blade> blades, int levels, const Adjacency* adjacency) {
    Location out;
    out.level.assign(mesh.points.size(), -1);
    if (mesh.points.empty()) throw ToolError("the mesh is empty: there is nothing to cut");
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& x : mesh.points) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    out.tolerance = 1e-10 * (high - low).norm();
    for (const Blade& blade : blades) {
        std::vector<double> distance(mesh.points.size());
        for (std::size_t n = 0; n < mesh.points.size(); ++n) distance[n] = blade.tool->distance(mesh.points[n]);
        touch(mesh, blade, distance, out);
        if (&blade == blades.data()) out.distance = std::move(distance);
    }

    std::vector<Index> front, next;
    if (adjacency)
        for (std::size_t n = 0; n < out.level.size(); ++n)
            if (out.level[n] == 0) front.push_back(static_cast<Index>(n));
    for (int level = 1; level <= levels; ++level) {
        const auto reach = [&](CellType type, Index cell, const Index* n) {
            static_cast<void>(cell);
            const int corners = traits(type).corners;
            bool near = false;
            for (int k = 0; k < corners; ++k) near = near || out.level[n[k]] == level - 1;
            if (!near) return;
            for (int k = 0; k < corners; ++k)
                if (out.level[n[k]] < 0) {
                    out.level[n[k]] = static_cast<std::int8_t>(level);
                    if (adjacency) next.push_back(n[k]);
                }
        };
        if (adjacency) {
            next.clear();
            for (Index n : front)
                adjacency->around(n, [&](CellType type, Index cell) {
                    if (traits(type).dimension >= 2) reach(type, cell, mesh.block(type).nodes(cell).data());
                });
            front.swap(next);
        } else {
            for (const CellBlock& b : mesh.blocks()) {
                const CellTraits& t = traits(b.type);
                if (t.dimension < 2) continue;
                const Index* n = b.connectivity.data();
                for (Index c = 0; c < b.size(); ++c, n += t.nodes) reach(b.type, c, n);
            }
        }
    }
    return out;
}

}  // namespace femscalpel
