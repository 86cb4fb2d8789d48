// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/quad_cuts.h"

#include <algorithm>
#include <utility>

#include "deformation/mid_sides.h"
#include "mesh/middles.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

/// Triangles that differ less in quality count as equally good.
constexpr double as_good = 0.05;

/// Faces with a node in their middle: corners, and its place in the element.
struct FaceMiddle {
    std::array<std::int8_t, 4> corners;
    int node;
};

constexpr FaceMiddle quad9_middles[] = {{{0, 1, 2, 3}, 8}};
constexpr FaceMiddle wedge18_middles[] = {{{0, 1, 4, 3}, 15}, {{1, 2, 5, 4}, 16}, {{2, 0, 3, 5}, 17}};
constexpr FaceMiddle hexahedron27_middles[] = {{{0, 4, 7, 3}, 20}, {{1, 2, 6, 5}, 21}, {{0, 1, 5, 4}, 22},
                                               {{3, 7, 6, 2}, 23}, {{0, 3, 2, 1}, 24}, {{4, 5, 6, 7}, 25}};

std::span<const FaceMiddle> face_middles(CellType type) {
    if (type == CellType::quad9) return quad9_middles;
    if (type == CellType::wedge18) return wedge18_middles;
    if (type == CellType::hexahedron27) return hexahedron27_middles;
    return {};
}

}  // namespace

QuadCuts::QuadCuts(Mesh& mesh, const CellLists& cells,
                   std::function<Index(const Blend&, const std::array<Index, 4>&)> add_node,
                   QuadTable<QuadDiagonal> given)
    : mesh_(mesh), given_(std::move(given)), add_node_(std::move(add_node)) {
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (!t.quadratic) continue;
        for (const Index c : cells[static_cast<int>(b.type)]) {
            const auto n = b.nodes(c);
            for (std::size_t e = 0; e < t.edges.size(); ++e)
                if (n[t.edges[e][0]] != n[t.edges[e][1]])
                    set_middle(n[t.edges[e][0]], n[t.edges[e][1]], n[static_cast<std::size_t>(t.corners) + e]);
            for (const FaceMiddle& f : face_middles(b.type))
                face_middles_.emplace(quad_key({n[f.corners[0]], n[f.corners[1]], n[f.corners[2]], n[f.corners[3]]}),
                                      n[f.node]);
        }
    }
}

Index QuadCuts::middle(Index a, Index b) const {
    const auto found = middles_.find(mesh_edge_key(a, b));
    return found == middles_.end() ? -1 : found->second;
}

void QuadCuts::set_middle(Index a, Index b, Index node) { middles_.emplace(mesh_edge_key(a, b), node); }

/// Mean ratio of a triangle with the diagonal a-c, less where its curved shape makes it worse.
double QuadCuts::quality(const std::array<Index, 3>& triangle, Index a, Index c, const Vec3& on_diagonal) const {
    std::array<Vec3, 6> x;
    for (int k = 0; k < 3; ++k) x[k] = mesh_.points[triangle[k]];
    const double straight = mean_ratio(x[0], x[1], x[2]);
    for (int k = 0; k < 3; ++k) {
        const Index from = triangle[k], to = triangle[(k + 1) % 3];
        const bool diagonal = (from == a && to == c) || (from == c && to == a);
        const Index middle_node = diagonal ? -1 : middle(from, to);
        if (!diagonal && middle_node < 0) return straight;
        x[3 + k] = diagonal ? on_diagonal : mesh_.points[middle_node];
    }
    const double curved = curved_ratio(x);
    return curved > 0 ? straight * std::min(1.0, curved) : std::min(curved, -1e-12);
}

/// The diagonal at the first or second of four corners.
QuadCuts::Choice QuadCuts::choice(const std::array<Index, 4>& q, int first) const {
    Choice out{{q[first], q[first + 2]}, {}, 0};
    std::array<Index, 8> nodes{q[0], q[1], q[2], q[3]};
    bool second_order = true;
    for (int k = 0; k < 4; ++k) {
        nodes[4 + k] = middle(q[k], q[(k + 1) % 4]);
        second_order = second_order && nodes[4 + k] >= 0;
    }
    if (const Index* there = face_middles_.find(quad_key(q))) {
        out.middle = {{*there, 1}};
    } else if (second_order) {
        out.middle = {{q[first], 0.5}};
        add(out.middle, {{q[first + 2], 0.5}});
        add(out.middle, ShapeBlend(CellType::quad8, nodes).bulge(Vec3::Zero()));
    }
    const Vec3 at = second_order ? place_of(mesh_, out.middle) : Vec3::Zero();
    const Index a = out.ends[0], c = out.ends[1], b = q[first + 1], d = q[(first + 3) % 4];
    out.quality = std::min(quality({a, b, c}, a, c, at), quality({a, c, d}, a, c, at));
    const auto normal = [&](Index i, Index j, Index k) -> Vec3 {
        return (mesh_.points[j] - mesh_.points[i]).cross(mesh_.points[k] - mesh_.points[i]);
    };
    if (normal(a, b, c).dot(normal(a, c, d)) <= 0) out.quality = -std::abs(out.quality);  // outside, at a dent
    return out;
}

std::array<Index, 2> QuadCuts::diagonal(const std::array<Index, 4>& corners) {
    const QuadKey key = quad_key(corners);
    if (const auto* known = diagonals_.find(key)) return {(*known)[0], (*known)[1]};
    // The same to the last bit, whichever way the quadrangle runs.
    const auto number = [&](Index n) { return mesh_.node_ids[n]; };
    std::array<Index, 4> q = corners;
    std::ranges::rotate(q, std::ranges::min_element(q, {}, number));
    if (number(q[3]) < number(q[1])) std::swap(q[1], q[3]);
    Choice best = choice(q, 0), other = choice(q, 1);
    const QuadDiagonal* given = given_.find(key);
    const bool takes_other = given ? std::ranges::find(*given, static_cast<std::int32_t>(q[0])) == given->end()
                                   : other.quality > best.quality + as_good * std::abs(best.quality);
    if (takes_other) best = std::move(other);
    if (best.middle.size() == 1 && best.middle.front().second == 1)
        set_middle(best.ends[0], best.ends[1], best.middle.front().first);
    else if (!best.middle.empty())
        set_middle(best.ends[0], best.ends[1], add_node_(best.middle, q));
    diagonals_.emplace(key, {static_cast<std::int32_t>(best.ends[0]), static_cast<std::int32_t>(best.ends[1])});
    return best.ends;
}

std::array<std::array<Index, 3>, 2> QuadCuts::triangles(const std::array<Index, 4>& q) {
    const std::array<Index, 2> ends = diagonal(q);
    if (std::ranges::find(ends, q[0]) != ends.end()) return {{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}};
    return {{{q[1], q[2], q[3]}, {q[1], q[3], q[0]}}};
}

}  // namespace femscalpel
