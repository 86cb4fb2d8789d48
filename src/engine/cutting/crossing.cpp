// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "cancel.h"

namespace femscalpel {
namespace {

/// Less than this part of the shapes' own measure is touching.
constexpr double just_touching = 1e-6;

struct Box {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;

    void add(const Vec3& x) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    bool meets(const Box& o) const {
        return (low.array() <= o.high.array()).all() && (o.low.array() <= high.array()).all();
    }
};

/// Whether the segment p-q passes through the inside of the triangle.
bool passes(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const double none = just_touching * normal.norm() * std::sqrt(normal.norm());
    const double at_p = normal.dot(p - t[0]), at_q = normal.dot(q - t[0]);
    if (std::abs(at_p) < none || std::abs(at_q) < none || (at_p > 0) == (at_q > 0)) return false;
    const Vec3 x = p + at_p / (at_p - at_q) * (q - p);
    for (int k = 0; k < 3; ++k)
        if ((t[(k + 1) % 3] - t[k]).cross(x - t[k]).dot(normal) < just_touching * normal.squaredNorm()) return false;
    return true;
}

/// Whether two segments of one plane cross in their insides.
bool cross(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
    const Vec3 u = q - p, v = b - a, n = u.cross(v);
    const double none = just_touching * u.norm() * v.norm();
    if (n.norm() <= none || std::abs(n.normalized().dot(a - p)) > just_touching * std::max(u.norm(), v.norm()))
        return false;
    const double s = (a - p).cross(v).dot(n) / n.squaredNorm(), t = (a - p).cross(u).dot(n) / n.squaredNorm();
    return s > just_touching && s < 1 - just_touching && t > just_touching && t < 1 - just_touching;
}

/// Whether a point is inside a simplex; of a triangle in space, inside it in its plane.
bool is_inside(const Vec3& x, std::span<const Vec3> corner) {
    const Vec3 a = corner[1] - corner[0], b = corner[2] - corner[0], r = x - corner[0], n = a.cross(b);
    if (corner.size() == 3) {
        if (std::abs(n.dot(r)) > just_touching * std::pow(n.squaredNorm(), 0.75)) return false;
        const double u = r.cross(b).dot(n) / n.squaredNorm(), v = a.cross(r).dot(n) / n.squaredNorm();
        return std::min({u, v, 1 - u - v}) > just_touching;
    }
    const Vec3 c = corner[3] - corner[0];
    const double all = n.dot(c);
    const double u = r.cross(b).dot(c) / all, v = a.cross(r).dot(c) / all, w = n.dot(r) / all;
    return std::min({u, v, w, 1 - u - v - w}) > just_touching;
}

/// The parts, in the cells of a grid.
class Grid {
public:
    Grid(const Mesh& mesh, std::span<const std::array<Index, 3>> parts) : mesh_(mesh), parts_(parts) {
        double extent = 0;
        for (const auto& part : parts) {
            Box b;
            for (const Index n : part)
                if (n >= 0) b.add(mesh.points[n]);
            all_.add(b.low);
            all_.add(b.high);
            extent += (b.high - b.low).norm();
            boxes_.push_back(b);
        }
        cell_ = std::max(extent / static_cast<double>(std::max<std::size_t>(1, parts.size())), 1e-300);
        for (int k = 0; k < static_cast<int>(parts.size()); ++k)
            for_each_cell(boxes_[k], [&](std::int64_t key) { in_cell_[key].push_back(k); });
    }

    /// Whether a part without a common node passes through the simplex.
    bool crosses(std::span<const Index> nodes) const {
        Box box;
        for (const Index n : nodes) box.add(mesh_.points[n]);
        if (!box.meets(all_)) return false;
        box.low = box.low.cwiseMax(all_.low);
        box.high = box.high.cwiseMin(all_.high);
        bool found = false;
        for_each_cell(box, [&](std::int64_t key) {
            const auto cell = in_cell_.find(key);
            if (found || cell == in_cell_.end()) return;
            found = std::ranges::any_of(cell->second, [&](int k) {
                const auto& part = parts_[k];
                return boxes_[k].meets(box) &&
                       std::ranges::none_of(part,
                                            [&](Index n) { return std::ranges::find(nodes, n) != nodes.end(); }) &&
                       crosses(part, nodes);
            });
        });
        return found;
    }

private:
    void for_each_cell(const Box& b, auto visit) const {
        std::array<std::int64_t, 3> from, to;
        for (int k = 0; k < 3; ++k) {
            from[k] = static_cast<std::int64_t>(std::floor((b.low[k] - all_.low[k]) / cell_));
            to[k] = static_cast<std::int64_t>(std::floor((b.high[k] - all_.low[k]) / cell_));
        }
        for (std::int64_t i = from[0]; i <= to[0]; ++i)
            for (std::int64_t j = from[1]; j <= to[1]; ++j)
                for (std::int64_t k = from[2]; k <= to[2]; ++k) visit(((i << 21) + j) << 21 | k);
    }

    bool crosses(const std::array<Index, 3>& part, std::span<const Index> nodes) const {
        const auto at = [&](Index n) -> const Vec3& { return mesh_.points[n]; };
        const int corners = part[2] < 0 ? 2 : 3;
        const int count = static_cast<int>(nodes.size());
        std::array<Vec3, 4> corner;
        for (int k = 0; k < count; ++k) corner[k] = at(nodes[k]);
        // Where meshes match, edges meet edges only; so points inside the part are looked at, too.
        for (const auto& weight : {std::array{0.31, 0.33, 0.36}, std::array{0.57, 0.32, 0.11}}) {
            const double rest = corners == 2 ? weight[2] / 2 : 0;
            Vec3 x = (weight[0] + rest) * at(part[0]) + (weight[1] + rest) * at(part[1]);
            if (corners == 3) x += weight[2] * at(part[2]);
            if (is_inside(x, std::span(corner).first(static_cast<std::size_t>(count)))) return true;
        }
        for (int i = 0; i < (corners == 2 ? 1 : 3); ++i) {
            const Vec3 &p = at(part[i]), &q = at(part[(i + 1) % corners]);
            for (int k = 0; k < (count == 4 ? 4 : 1); ++k) {
                std::array<Vec3, 3> face;
                for (int c = 0, j = 0; c < count && j < 3; ++c)
                    if (count == 3 || c != k) face[j++] = at(nodes[c]);
                if (passes(p, q, face)) return true;
            }
            if (count == 3 && corners == 2)
                for (int k = 0; k < 3; ++k)
                    if (cross(p, q, at(nodes[k]), at(nodes[(k + 1) % 3]))) return true;
        }
        if (corners == 2) return false;
        const std::array<Vec3, 3> face{at(part[0]), at(part[1]), at(part[2])};
        for (int a = 0; a < count; ++a)
            for (int b = 0; b < a; ++b)
                if (passes(at(nodes[a]), at(nodes[b]), face)) return true;
        return false;
    }

    const Mesh& mesh_;
    std::span<const std::array<Index, 3>> parts_;
    std::vector<Box> boxes_;
    Box all_;
    double cell_ = 1;
    std::unordered_map<std::int64_t, std::vector<int>> in_cell_;
};

}  // namespace

std::optional<CellRef> crossed_element(const Mesh& mesh, std::span<const std::array<Index, 3>> parts) {
    if (parts.empty()) return {};
    const Grid grid(mesh, parts);
    SparseCheck check(256);
    const bool solid = mesh.dimension() == 3;
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (!t.simplex || t.dimension != (solid ? 3 : 2)) continue;
        for (Index c = 0; c < b.size(); ++c) {
            check();
            if (grid.crosses(b.nodes(c).subspan(0, static_cast<std::size_t>(t.corners)))) return CellRef{b.type, c};
        }
    }
    return {};
}

}  // namespace femscalpel
