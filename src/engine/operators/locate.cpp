// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/locate.h"

#include <cmath>
#include <sstream>

namespace femscalpel {

namespace {

/// On which side of the tool a node is, as bits, so that those of an element can be joined.
constexpr std::uint8_t behind = 1, on = 2, before = 4;

/// Visits the elements of dimension 2 and more: type and corner nodes.
template <class Visit>
void for_each_element(const Mesh& mesh, Visit visit) {
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < 2) continue;
        const Index* n = b.connectivity.data();
        const Index count = b.size();
        const auto pass = [&](int corners) {
            for (Index c = 0; c < count; ++c, n += t.nodes) visit(n, corners);
        };
        // A constant lets the compiler unroll what is inside, for the elements that matter.
        if (t.corners == 4) pass(4);
        else pass(t.corners);
    }
}

}  // namespace

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

    std::vector<std::uint8_t> side(mesh.points.size());
    for (std::size_t n = 0; n < side.size(); ++n)
        side[n] = out.distance[n] < -out.tolerance ? behind : out.distance[n] > out.tolerance ? before : on;
    bool touched = false;
    for_each_element(mesh, [&](const Index* n, int corners) {
        std::uint8_t sides = 0;
        for (int k = 0; k < corners; ++k) sides |= side[n[k]];
        if (sides == behind || sides == before) return;
        const bool crossed = (sides & behind) && (sides & before);
        if (crossed) ++out.crossed;
        for (int k = 0; k < corners; ++k)
            if (crossed || side[n[k]] == on) out.level[n[k]] = 0;
        touched = true;
    });
    if (!touched) {
        std::ostringstream message;
        message << "the " << tool.kind() << " misses the mesh: the whole mesh lies on its " << (nearest > 0 ? "positive" : "negative")
                << " side, the nearest node at distance " << std::abs(nearest) << ". Move the " << tool.kind() << " or turn it";
        throw ToolError(message.str());
    }

    std::vector<Index> front, next;
    if (adjacency)
        for (std::size_t n = 0; n < out.level.size(); ++n)
            if (out.level[n] == 0) front.push_back(static_cast<Index>(n));
    for (int level = 1; level <= levels; ++level) {
        if (!adjacency) {
            for_each_element(mesh, [&](const Index* n, int corners) {
                bool near = false;
                for (int k = 0; k < corners; ++k) near |= out.level[n[k]] == level - 1;
                if (!near) return;
                for (int k = 0; k < corners; ++k)
                    if (out.level[n[k]] < 0) out.level[n[k]] = static_cast<std::int8_t>(level);
            });
            continue;
        }
        next.clear();
        for (const Index at : front)
            adjacency->around(at, [&](CellType type, Index cell) {
                const CellTraits& t = traits(type);
                if (t.dimension < 2) return;
                const Index* n = mesh.block(type).nodes(cell).data();
                for (int k = 0; k < t.corners; ++k) {
                    if (out.level[n[k]] >= 0) continue;
                    out.level[n[k]] = static_cast<std::int8_t>(level);
                    next.push_back(n[k]);
                }
            });
        front.swap(next);
    }
    return out;
}

}  // namespace femscalpel
