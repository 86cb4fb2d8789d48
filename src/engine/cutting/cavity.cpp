// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/cavity.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>
#include <string>

#include "cancel.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

[[noreturn]] void refuse(const char* why, const Vec3& at) { throw CavityError(why, at); }

std::string text_of(const char* why, const Vec3& at) {
    std::ostringstream message;
    message << "no volume to be filled: " << why << " near (" << at.transpose() << ")";
    return message.str();
}

/// The same for all rotations of a triangle.
Triangle smallest_first(Triangle t) {
    std::ranges::rotate(t, std::ranges::min_element(t));
    return t;
}

Vec3 centre(std::span<const Vec3> points, const Triangle& t) {
    return (points[t[0]] + points[t[1]] + points[t[2]]) / 3;
}

Vec3 normal(std::span<const Vec3> points, const Triangle& t) {
    return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

void check_closed(std::span<const Vec3> points, std::span<const Triangle> triangles) {
    std::map<std::array<int, 2>, int> balance;
    std::vector<Triangle> sorted;
    for (const Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            if (a == b) refuse("a triangle with a node twice", points[a]);
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
        if (mean_ratio(points[t[0]], points[t[1]], points[t[2]]) < 1e-6) refuse("a flat triangle", centre(points, t));
        sorted.push_back(t);
        std::ranges::sort(sorted.back());
    }
    for (const auto& [edge, n] : balance)
        if (n != 0) refuse("an open edge", (points[edge[0]] + points[edge[1]]) / 2);
    std::ranges::sort(sorted);
    const auto twice = std::ranges::adjacent_find(sorted);
    if (twice != sorted.end()) refuse("a triangle that is there twice", centre(points, *twice));
}

/// Whether the segment from p to q goes through a triangle.
bool crosses(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c, double tiny) {
    const double above = signed_volume(a, b, c, p), below = signed_volume(a, b, c, q);
    if (std::min(above, below) > -tiny || std::max(above, below) < tiny) return false;
    const double u = signed_volume(p, q, a, b), v = signed_volume(p, q, b, c), w = signed_volume(p, q, c, a);
    return std::min({u, v, w}) > -tiny || std::max({u, v, w}) < tiny;
}

/// Throws where an edge of a triangle goes through another triangle; a sweep along x finds the pairs.
class CrossingCheck {
public:
    CrossingCheck(std::span<const Vec3> points, std::span<const Triangle> triangles)
        : points_(points), triangles_(triangles) {
        for (const Triangle& t : triangles) {
            Eigen::AlignedBox3d box;
            for (const int v : t) box.extend(points[v]);
            boxes_.push_back(box);
        }
    }

    void run() const {
        std::vector<int> order(triangles_.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::sort(order, {}, [this](int t) { return boxes_[t].min().x(); });
        for (std::size_t i = 0; i < order.size(); ++i) {
            check_cancelled();
            const auto& box = boxes_[order[i]];
            for (std::size_t j = i + 1; j < order.size() && boxes_[order[j]].min().x() <= box.max().x(); ++j)
                if (box.intersects(boxes_[order[j]])) check(order[i], order[j]);
        }
    }

private:
    void check(int s, int t) const {
        if (any_edge_crosses(triangles_[s], triangles_[t]) || any_edge_crosses(triangles_[t], triangles_[s]))
            refuse("triangles that cross", (centre(points_, triangles_[s]) + centre(points_, triangles_[t])) / 2);
    }

    bool any_edge_crosses(const Triangle& edges, const Triangle& t) const {
        const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
        for (int k = 0; k < 3; ++k) {
            const int p = edges[k], q = edges[(k + 1) % 3];
            if (std::ranges::count(t, p) + std::ranges::count(t, q) > 0) continue;
            const double size = (points_[p] - points_[q]).norm() + (b - a).norm() + (c - a).norm();
            if (crosses(points_[p], points_[q], a, b, c, 1e-12 * size * size * size)) return true;
        }
        return false;
    }

    std::span<const Vec3> points_;
    std::span<const Triangle> triangles_;
    std::vector<Eigen::AlignedBox3d> boxes_;
};

}  // namespace

Triangle sorted(Triangle face) {
    std::ranges::sort(face);
    return face;
}

std::set<DirectedEdge> directed_edges(std::span<const Triangle> triangles) {
    std::set<DirectedEdge> out;
    for (const Triangle& t : triangles)
        for (int k = 0; k < 3; ++k) out.insert({t[k], t[(k + 1) % 3]});
    return out;
}

double enclosed_volume(std::span<const Vec3> points, std::span<const Triangle> triangles) {
    double volume = 0;
    if (triangles.empty()) return volume;
    const Vec3& origin = points[triangles[0][0]];
    for (const Triangle& t : triangles) volume += signed_volume(points[t[0]], points[t[1]], points[t[2]], origin);
    return -volume;
}

CavityError::CavityError(const char* why_not, const Vec3& where)
    : QualityError(text_of(why_not, where)), why(why_not), at(where) {}

void check_cavity(std::span<const Vec3> points, std::span<const Triangle> triangles) {
    if (triangles.empty()) refuse("no triangles", points.empty() ? Vec3(Vec3::Zero()) : points.front());
    check_closed(points, triangles);
    if (!(enclosed_volume(points, triangles) > 0))
        refuse("triangles that look inwards or enclose nothing", centre(points, triangles[0]));
    CrossingCheck(points, triangles).run();
}

SharpestEdge sharpest_edge(std::span<const Vec3> points, std::span<const Triangle> triangles) {
    std::map<std::array<int, 2>, std::size_t> side;
    for (std::size_t k = 0; k < triangles.size(); ++k)
        for (int e = 0; e < 3; ++e) side[{triangles[k][e], triangles[k][(e + 1) % 3]}] = k;
    SharpestEdge sharpest;
    for (const auto& [edge, k] : side) {
        const auto other = side.find({edge[1], edge[0]});
        if (edge[0] > edge[1] || other == side.end()) continue;
        const Vec3 along = (points[edge[1]] - points[edge[0]]).normalized();
        const Vec3 m = normal(points, triangles[k]), n = normal(points, triangles[other->second]);
        // 180 degrees where both lie in one plane.
        const double turned = std::atan2(m.cross(n).dot(along), m.dot(n)) * 180 / std::numbers::pi;
        const double inside = 180 - turned;
        if (inside < sharpest.degrees) sharpest = {(points[edge[0]] + points[edge[1]]) / 2, inside};
    }
    return sharpest;
}

double check_filling(std::span<const Vec3> points, std::span<const Triangle> triangles, std::span<const Tetra> tetras) {
    double worst = 1, volume = 0;
    std::map<Triangle, int> open;
    const auto face = [&](const Triangle& t, int by) {
        const Triangle key = smallest_first(t), back = smallest_first({t[0], t[2], t[1]});
        const auto found = open.find(back);
        if (found == open.end())
            open[key] += by;
        else if (--found->second == 0)
            open.erase(found);
    };
    for (const Tetra& t : tetras) {
        const auto& [a, b, c, d] = t;
        const double ratio = mean_ratio(points[a], points[b], points[c], points[d]);
        if (!(ratio > 0)) refuse("a flat or inverted element", (points[a] + points[b] + points[c] + points[d]) / 4);
        worst = std::min(worst, ratio);
        volume += signed_volume(points[a], points[b], points[c], points[d]);
        // Outwards.
        for (const Triangle& f : {Triangle{a, c, b}, Triangle{a, b, d}, Triangle{b, c, d}, Triangle{a, d, c}})
            face(f, 1);
    }
    for (const Triangle& t : triangles) face({t[0], t[2], t[1]}, 1);
    if (!open.empty()) refuse("a face that is not as it was", centre(points, open.begin()->first));
    const double enclosed = enclosed_volume(points, triangles);
    if (std::abs(volume - enclosed) > 1e-9 * enclosed)
        refuse("elements that leave or overlap it", centre(points, triangles[0]));
    return worst;
}

}  // namespace femscalpel
