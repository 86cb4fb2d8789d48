// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/locate.h"

#include <cmath>
#include <string>

#include "cutting/no_cut.h"

#include "mesh/rounding.h"

#include "cancel.h"

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
        const auto pass = [&](auto corners) {
            for (Index c = 0; c < count; ++c, n += t.nodes) visit(n, corners);
        };
        // A constant lets the compiler unroll what is inside, for the elements that matter.
        if (t.corners == 4)
            pass(std::integral_constant<int, 4>());
        else
            pass(t.corners);
    }
}

/// Longest edge of an element, by its corners.
double longest_edge(const Mesh& mesh, int corners, const Index* n) {
    double longest = 0;
    for (int a = 0; a < corners; ++a)
        for (int b = 0; b < a; ++b) longest = std::max(longest, (mesh.points[n[a]] - mesh.points[n[b]]).squaredNorm());
    return std::sqrt(longest);
}

/// Marks the nodes of elements that one blade touches with level 0; whether there are any. If not, `why` says so.
bool touch(const Mesh& mesh, const Blade& blade, const std::vector<double>& distance, Location& out, std::string& why) {
    std::vector<std::uint8_t> side(distance.size());
    for (std::size_t n = 0; n < side.size(); ++n)
        side[n] = distance[n] < -out.rounding ? behind : distance[n] > out.rounding ? before : on;
    bool touched = !out.stops.empty(), beyond = false;
    SparseCheck check(64);
    check_cancelled();
    for_each_element(mesh, [&](const Index* n, int corners) {
        std::uint8_t sides = 0;
        for (int k = 0; k < corners; ++k) sides |= side[n[k]];
        if (sides == behind || sides == before) return;
        check();
        if (blade.bound) {
            double bound = std::numeric_limits<double>::infinity();
            for (int k = 0; k < corners; ++k) bound = std::min(bound, blade.bound(mesh.points[n[k]]));
            if (bound > blade_margin * longest_edge(mesh, corners, n)) {
                beyond = true;
                return;
            }
        }
        const bool crossed = (sides & behind) && (sides & before);
        if (crossed) ++out.crossed;
        for (int k = 0; k < corners; ++k)
            if (crossed || side[n[k]] == on) out.level[n[k]] = 0;
        touched = true;
    });
    for (const CellType type : {CellType::line, CellType::line3})
        for (Index c = 0; c < mesh.block(type).size(); ++c) {
            const auto ends = mesh.block(type).nodes(c).first(2);
            beyond = beyond || (side[ends[0]] | side[ends[1]]) == (behind | before);
            for (const Index n : ends) {
                if (side[n] != on) continue;
                if (blade.bound && blade.bound(mesh.points[n]) > out.rounding) {
                    beyond = true;
                } else {
                    out.level[n] = 0;
                    touched = true;
                }
            }
        }
    if (!touched && why.empty()) why = why_missed(mesh, blade, distance, out.tolerance, beyond && blade.bound);
    return touched;
}

}  // namespace

Reach reach_of_rounding(const Mesh& mesh) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& x : mesh.points) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const double tolerance = 1e-10 * (high - low).norm();
    // In the direction of a tool's normal, the roundings of three coordinates add up.
    return {tolerance, std::max(tolerance, 2 * coordinate_rounding(mesh.points))};
}

Location locate(const Mesh& mesh, std::span<const Blade> blades, int levels, const Adjacency* adjacency,
                std::span<const Index> stops) {
    Location out;
    out.level.assign(mesh.points.size(), -1);
    if (mesh.points.empty()) throw ToolError("the mesh is empty: there is nothing to cut");
    const auto [tolerance, rounding] = reach_of_rounding(mesh);
    out.tolerance = tolerance;
    out.rounding = rounding;
    if (!stops.empty()) {
        const NumberIndex numbers(mesh);
        for (const Index number : stops)
            if (const auto n = numbers.node(number)) {
                out.stops.push_back(*n);
                out.level[*n] = 0;
            }
        std::ranges::sort(out.stops);
    }
    // A body, whose walls bound each other, may have some that meet nothing.
    bool touched = true;
    std::string why;
    for (const Blade& blade : blades) {
        if (blade.inside.empty()) {
            if (!touched) throw ToolError(why);
            touched = false;
            why.clear();
        }
        std::vector<double> distance(mesh.points.size());
        SparseCheck check(256);  // distances to CAD faces take their time
        for (std::size_t n = 0; n < mesh.points.size(); ++n, check())
            distance[n] = blade.tool->distance(mesh.points[n]);
        touched = touch(mesh, blade, distance, out, why) || touched;
        if (&blade == blades.data()) out.distance = std::move(distance);
    }
    if (!touched) throw ToolError(why);

    spread_levels(mesh, out.level, levels, adjacency);
    return out;
}

int bandwidth(const Location& location, const Mesh& mesh) {
    double largest = 0, length = 0;
    long edges = 0;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < 2) continue;
        const Index* n = b.connectivity.data();
        for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
            bool touched = false;
            for (int k = 0; k < t.corners; ++k) touched = touched || location.level[n[k]] == 0;
            if (!touched) continue;
            for (const auto& e : t.edges) {
                const Index a = n[e[0]], d = n[e[1]];
                if (location.level[a] != 0 || location.level[d] != 0) continue;
                length += (mesh.points[a] - mesh.points[d]).norm();
                ++edges;
                largest = std::max(largest, std::min(std::abs(location.distance[a]), std::abs(location.distance[d])));
            }
        }
    }
    if (edges == 0) return 2;
    return std::max(2, static_cast<int>(std::lround(largest / (length / static_cast<double>(edges)))));
}

void spread_levels(const Mesh& mesh, std::vector<std::int8_t>& levels, int count, const Adjacency* adjacency) {
    std::vector<Index> front, next;
    if (adjacency)
        for (std::size_t n = 0; n < levels.size(); ++n)
            if (levels[n] == 0) front.push_back(static_cast<Index>(n));
    for (int level = 1; level <= count; ++level) {
        check_cancelled();
        if (!adjacency) {
            for_each_element(mesh, [&](const Index* n, int corners) {
                bool near = false;
                for (int k = 0; k < corners; ++k) near |= levels[n[k]] == level - 1;
                if (!near) return;
                for (int k = 0; k < corners; ++k)
                    if (levels[n[k]] < 0) levels[n[k]] = static_cast<std::int8_t>(level);
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
                    if (levels[n[k]] >= 0) continue;
                    levels[n[k]] = static_cast<std::int8_t>(level);
                    next.push_back(n[k]);
                }
            });
        front.swap(next);
    }
}

}  // namespace femscalpel
