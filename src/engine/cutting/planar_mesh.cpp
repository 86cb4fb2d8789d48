// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/planar_mesh.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace femscalpel {
namespace {

double area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x())) / 2;
}

double shape(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return squares > 0 ? 4 * std::sqrt(3.0) * area(a, b, c) / squares : 0;
}

double distance_to_segment(const Vec2& x, const Vec2& a, const Vec2& b) {
    const Vec2 ab = b - a;
    const double t = std::clamp(ab.dot(x - a) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
    return (a + t * ab - x).norm();
}

bool is_inside(std::span<const Vec2> polygon, const Vec2& x) {
    bool in = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Vec2 &a = polygon[i], &b = polygon[j];
        if ((a.y() > x.y()) != (b.y() > x.y()) && x.x() < (b.x() - a.x()) * (x.y() - a.y()) / (b.y() - a.y()) + a.x())
            in = !in;
    }
    return in;
}

/// Triangles of a polygon, by cutting off the best ear again and again.
std::vector<Triangle> cut_ears(std::span<const Vec2> p) {
    std::vector<int> ring(p.size());
    std::iota(ring.begin(), ring.end(), 0);
    std::vector<Triangle> out;
    const auto quality = [&](std::size_t k) {
        const std::size_t n = ring.size();
        const int a = ring[(k + n - 1) % n], b = ring[k], c = ring[(k + 1) % n];
        const double q = shape(p[a], p[b], p[c]);
        if (!(q > 1e-9)) return -1.0;
        const double tiny = 1e-10 * area(p[a], p[b], p[c]);
        for (const int v : ring) {
            if (v == a || v == b || v == c || p[v] == p[a] || p[v] == p[b] || p[v] == p[c]) continue;
            if (area(p[a], p[b], p[v]) >= -tiny && area(p[b], p[c], p[v]) >= -tiny && area(p[c], p[a], p[v]) >= -tiny)
                return -1.0;
        }
        return q;
    };
    std::vector<double> qualities(ring.size());
    for (std::size_t k = 0; k < ring.size(); ++k) qualities[k] = quality(k);
    while (ring.size() > 3) {
        const std::size_t k = std::ranges::max_element(qualities) - qualities.begin(), n = ring.size();
        if (qualities[k] < 0) throw QualityError("the outline of a surface to be meshed crosses itself");
        out.push_back({ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(k));
        qualities.erase(qualities.begin() + static_cast<std::ptrdiff_t>(k));
        const std::size_t m = ring.size();
        qualities[k % m] = quality(k % m);
        qualities[(k + m - 1) % m] = quality((k + m - 1) % m);
        // What the ear's tip blocked may be free now.
        if (std::ranges::all_of(qualities, [](double q) { return q < 0; }))
            for (std::size_t j = 0; j < m; ++j) qualities[j] = quality(j);
    }
    out.push_back({ring[0], ring[1], ring[2]});
    return out;
}

/// Triangles whose inner edges can be flipped.
class Triangulation {
public:
    Triangulation(std::vector<Vec2> points, std::vector<Triangle> triangles)
        : points_(std::move(points)), triangles_(std::move(triangles)) {
        for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) link(t);
        for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) suspect(t);
        flip();
    }

    void insert(int v) {
        const Vec2& x = points_[v];
        const int first = walk_to(x);
        for (int k = 0; k < static_cast<int>(triangles_.size()); ++k) {
            const int t = (first + k) % static_cast<int>(triangles_.size());
            const auto [a, b, c] = triangles_[t];
            const double whole = area(points_[a], points_[b], points_[c]);
            const double u = area(x, points_[b], points_[c]), w = area(points_[a], x, points_[c]),
                         z = area(points_[a], points_[b], x);
            if (std::min({u, w, z}) < -1e-12 * whole) continue;
            // Too near an edge to make triangles of it with no flip.
            if (std::min({u, w, z}) < 1e-3 * whole) {
                const std::array<int, 2> edge =
                    u <= w && u <= z ? std::array{b, c} : (w <= z ? std::array{c, a} : std::array{a, b});
                split_edge(edge[0], edge[1], v);
            } else {
                set(t, {a, b, v});
                add({b, c, v});
                add({c, a, v});
            }
            flip();
            return;
        }
    }

    std::vector<Triangle> take() { return std::move(triangles_); }

private:
    using Edge = std::pair<int, int>;

    /// A triangle at or near a point, by way of neighbours from the last one made.
    int walk_to(const Vec2& x) const {
        int t = static_cast<int>(triangles_.size()) - 1;
        for (std::size_t steps = 0; steps < triangles_.size(); ++steps) {
            int next = -1;
            for (int k = 0; k < 3 && next < 0; ++k) {
                const int a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
                if (area(points_[a], points_[b], x) >= 0) continue;
                const auto beyond = at_.find({b, a});
                if (beyond != at_.end()) next = beyond->second;
            }
            if (next < 0) break;
            t = next;
        }
        return t;
    }

    void link(int t) {
        for (int k = 0; k < 3; ++k) at_[{triangles_[t][k], triangles_[t][(k + 1) % 3]}] = t;
    }
    void suspect(int t) {
        for (int k = 0; k < 3; ++k) queue_.push_back({triangles_[t][k], triangles_[t][(k + 1) % 3]});
    }
    void set(int t, const Triangle& nodes) {
        for (int k = 0; k < 3; ++k) {
            const auto old = at_.find({triangles_[t][k], triangles_[t][(k + 1) % 3]});
            if (old != at_.end() && old->second == t) at_.erase(old);
        }
        triangles_[t] = nodes;
        link(t);
        suspect(t);
    }
    void add(const Triangle& nodes) {
        triangles_.push_back(nodes);
        link(static_cast<int>(triangles_.size()) - 1);
        suspect(static_cast<int>(triangles_.size()) - 1);
    }
    int opposite(int t, int a, int b) const {
        for (const int v : triangles_[t])
            if (v != a && v != b) return v;
        return -1;
    }

    /// The triangles at an inner edge; nothing at the outline.
    void split_edge(int a, int b, int v) {
        const auto left = at_.find({a, b}), right = at_.find({b, a});
        if (left == at_.end() || right == at_.end()) return;
        const int s = left->second, t = right->second, c = opposite(s, a, b), d = opposite(t, a, b);
        set(s, {a, v, c});
        set(t, {v, a, d});
        add({v, b, c});
        add({b, v, d});
    }

    /// Lawson: flips edges until each circle around a triangle is empty of the neighbours' points.
    void flip() {
        std::size_t left = 200 * (triangles_.size() + queue_.size());
        while (!queue_.empty() && left-- > 0) {
            const auto [a, b] = queue_.front();
            queue_.pop_front();
            const auto one = at_.find({a, b}), other = at_.find({b, a});
            if (one == at_.end() || other == at_.end()) continue;
            const int s = one->second, t = other->second, c = opposite(s, a, b), d = opposite(t, a, b);
            const Vec2 &pa = points_[a], &pb = points_[b], &pc = points_[c], &pd = points_[d];
            // The angles opposite the edge add up to more than 180 degrees.
            const Vec2 ca = pa - pc, cb = pb - pc, da = pa - pd, db = pb - pd;
            const double sin_c = ca.x() * cb.y() - ca.y() * cb.x(), sin_d = db.x() * da.y() - db.y() * da.x();
            const double sum = sin_c * da.dot(db) + sin_d * ca.dot(cb);
            if (sum >= -1e-12 * ca.norm() * cb.norm() * da.norm() * db.norm()) continue;
            const double now = area(pa, pb, pc) + area(pb, pa, pd);
            if (area(pc, pd, pb) < 1e-9 * now || area(pd, pc, pa) < 1e-9 * now) continue;
            set(s, {c, d, b});
            set(t, {d, c, a});
        }
        queue_.clear();
    }

    std::vector<Vec2> points_;
    std::vector<Triangle> triangles_;
    std::map<Edge, int> at_;  // triangle left of each directed edge
    std::deque<Edge> queue_;
};

}  // namespace

double polygon_area(std::span<const Vec2> polygon) {
    double sum = 0;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
        sum += area(polygon[0], polygon[j], polygon[i]);
    return sum;
}

std::vector<Vec2> points_inside(std::span<const Vec2> polygon, double spacing) {
    std::vector<Vec2> out;
    Eigen::AlignedBox2d box;
    for (const Vec2& p : polygon) box.extend(p);
    const double height = spacing * std::sqrt(0.75);
    int row = 0;
    for (double y = box.min().y() + height / 2; y < box.max().y(); y += height, ++row)
        for (double x = box.min().x() + (row % 2 ? spacing / 2 : 0); x < box.max().x(); x += spacing) {
            const Vec2 p(x, y);
            if (!is_inside(polygon, p)) continue;
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
                nearest = std::min(nearest, distance_to_segment(p, polygon[i], polygon[j]));
            if (nearest > 0.6 * spacing) out.push_back(p);
        }
    return out;
}

std::vector<Triangle> triangulate(std::span<const Vec2> polygon, std::span<const Vec2> inside) {
    std::vector<Vec2> points(polygon.begin(), polygon.end());
    points.insert(points.end(), inside.begin(), inside.end());
    Triangulation all(points, cut_ears(polygon));
    for (std::size_t k = polygon.size(); k < points.size(); ++k) all.insert(static_cast<int>(k));
    std::vector<Triangle> triangles = all.take();
    double sum = 0;
    bool sound = true;
    for (const Triangle& t : triangles) {
        sum += area(points[t[0]], points[t[1]], points[t[2]]);
        sound = sound && area(points[t[0]], points[t[1]], points[t[2]]) > 0;
    }
    if (!sound || !(std::abs(sum - polygon_area(polygon)) <= 1e-9 * sum))
        throw QualityError("the outline of a surface to be meshed crosses itself");
    return triangles;
}

void smooth(std::vector<Vec2>& points, std::size_t first, std::span<const Triangle> triangles, int rounds) {
    std::vector<std::vector<int>> around(points.size());
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
        for (const int v : triangles[t]) around[v].push_back(t);
    const auto worst = [&](std::size_t v) {
        double q = 1;
        for (const int t : around[v])
            q = std::min(q, shape(points[triangles[t][0]], points[triangles[t][1]], points[triangles[t][2]]));
        return q;
    };
    for (int round = 0; round < rounds; ++round)
        for (std::size_t v = first; v < points.size(); ++v) {
            if (around[v].empty()) continue;
            Vec2 sum = Vec2::Zero();
            for (const int t : around[v])
                for (const int w : triangles[t])
                    if (w != static_cast<int>(v)) sum += points[w];
            const Vec2 old = points[v];
            const double before = worst(v);
            points[v] = sum / (2.0 * static_cast<double>(around[v].size()));
            if (worst(v) < before) points[v] = old;
        }
}

}  // namespace femscalpel
