// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/border_overlap.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "cancel.h"
#include "mesh/closest_point.h"
#include "mesh/near_boxes.h"

namespace femscalpel {
namespace {

/// What is nearer than this part of an edge to it lies on it.
constexpr double touching = 1e-6;

/// Edges with just one shell triangle; of those on the band's own border, whose nodes never move, not all are the
/// mesh's.
std::vector<std::array<int, 2>> border_edges(const Deformable& d) {
    std::map<std::array<int, 2>, int> count;
    for (int t = 0; t < d.band.triangles.size(); ++t) {
        if (!d.band.triangles.alive(t) || !d.constraints.is_shell(d.band.triangles.origin(t))) continue;
        const auto& n = d.band.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) ++count[{std::min(n[k], n[(k + 1) % 3]), std::max(n[k], n[(k + 1) % 3])}];
    }
    std::vector<std::array<int, 2>> out;
    for (const auto& [edge, triangles] : count)
        if (triangles == 1 && (d.band.nodes[edge[0]].movable() || d.band.nodes[edge[1]].movable())) out.push_back(edge);
    return out;
}

}  // namespace

std::optional<Vec3> border_overlap(const Deformable& d) {
    const auto& nodes = d.band.nodes;
    const std::vector<std::array<int, 2>> edges = border_edges(d);
    std::set<int> ends;
    std::vector<Eigen::AlignedBox3d> boxes, points;
    for (const auto& [a, b] : edges) {
        ends.insert({a, b});
        Eigen::AlignedBox3d box = Eigen::AlignedBox3d(nodes[a].at).extend(nodes[b].at);
        const Vec3 more = Vec3::Constant(touching * box.diagonal().norm());
        boxes.emplace_back(box.min() - more, box.max() + more);
    }
    const std::vector<int> border(ends.begin(), ends.end());
    points.reserve(border.size());
    for (const int v : border) points.emplace_back(nodes[v].at);
    SparseCheck check(256);
    for (const auto& [k, e] : near_boxes(points, boxes)) {
        check();
        const int v = border[k];
        const auto& [a, b] = edges[e];
        if (v == a || v == b) continue;
        const double off = (closest_on_segment(nodes[a].at, nodes[b].at, nodes[v].at) - nodes[v].at).norm();
        if (off <= touching * (nodes[b].at - nodes[a].at).norm()) return nodes[v].at;
    }
    return {};
}

}  // namespace femscalpel
