// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/mend_filling.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "cancel.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

/// Elements with a smaller mean ratio are worth it.
constexpr double flat = 0.1;
/// So many times better has the worst around an edge to become.
constexpr double better = 1.5;
/// Steps of the search for a new point's place, and how much shorter each that finds nothing makes the next.
constexpr int most_steps = 40;
constexpr double shorter = 0.6;
/// As many edges are divided as there is one for so many elements, and a few.
constexpr std::size_t elements_per_edge = 50, a_few = 10;

constexpr std::array<std::array<int, 2>, 6> edges_of_tetra = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

class FillingMender {
public:
    FillingMender(std::vector<Vec3>& points, std::span<const Triangle> triangles, std::vector<Tetra>& tetras)
        : points_(points), tetras_(tetras) {
        for (const Triangle& t : triangles)
            for (int k = 0; k < 3; ++k) outer_.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }

    void run() {
        std::set<Tetra> given_up;
        for (std::size_t left = tetras_.size() / elements_per_edge + a_few; left > 0; --left) {
            check_cancelled();
            const auto worst = worst_but(given_up);
            if (!worst) return;
            if (!divide_at(tetras_[*worst])) given_up.insert(tetras_[*worst]);
        }
    }

private:
    /// An edge divided.
    struct Division {
        int a, b;
        std::vector<std::size_t> around;  // elements
        Vec3 at;
        double worst;  // of what they become
    };

    double ratio(const Tetra& t) const {
        return mean_ratio(points_[t[0]], points_[t[1]], points_[t[2]], points_[t[3]]);
    }

    std::optional<std::size_t> worst_but(const std::set<Tetra>& given_up) const {
        std::optional<std::size_t> out;
        double least = flat;
        for (std::size_t k = 0; k < tetras_.size(); ++k)
            if (const double q = ratio(tetras_[k]); q < least && !given_up.contains(tetras_[k])) {
                least = q;
                out = k;
            }
        return out;
    }

    bool divide_at(const Tetra& element) {
        std::optional<Division> best;
        for (const auto& [i, j] : edges_of_tetra) {
            const auto [a, b] = std::minmax(element[i], element[j]);
            if (outer_.contains({a, b})) continue;
            Division d = divided(a, b);
            if (!best || d.worst > best->worst) best = std::move(d);
        }
        if (!best) return false;
        double before = 1;
        for (const std::size_t k : best->around) before = std::min(before, ratio(tetras_[k]));
        if (!(best->worst > better * std::max(before, 0.0))) return false;
        const int fresh = static_cast<int>(points_.size());
        points_.push_back(best->at);
        for (const std::size_t k : best->around) {
            Tetra other = tetras_[k];
            std::ranges::replace(tetras_[k], best->b, fresh);
            std::ranges::replace(other, best->a, fresh);
            tetras_.push_back(other);
        }
        return true;
    }

    /// The best place for a point on an edge, or beside it, by a search along the axes.
    Division divided(int a, int b) const {
        Division out{a, b, {}, Vec3::Zero(), 0};
        std::set<int> nodes;
        for (std::size_t k = 0; k < tetras_.size(); ++k) {
            const auto has = [&](int v) { return std::ranges::find(tetras_[k], v) != tetras_[k].end(); };
            if (!has(a) || !has(b)) continue;
            out.around.push_back(k);
            nodes.insert(tetras_[k].begin(), tetras_[k].end());
        }
        const Vec3 middle = (points_[a] + points_[b]) / 2;
        Vec3 centre = Vec3::Zero();
        for (const int v : nodes) centre += points_[v] / static_cast<double>(nodes.size());
        out.at = centre;
        out.worst = worst_at(out, centre);
        if (const double q = worst_at(out, middle); q > out.worst) {
            out.at = middle;
            out.worst = q;
        }
        double step = 0.3 * (points_[a] - points_[b]).norm();
        for (int k = 0; k < most_steps; ++k) {
            bool moved = false;
            for (int axis = 0; axis < 6; ++axis) {
                const Vec3 x = out.at + (axis < 3 ? step : -step) * Vec3::Unit(axis % 3);
                if (const double q = worst_at(out, x); q > out.worst) {
                    out.at = x;
                    out.worst = q;
                    moved = true;
                }
            }
            if (!moved) step *= shorter;
        }
        return out;
    }

    /// The smallest mean ratio around the edge, were it divided at x.
    double worst_at(const Division& d, const Vec3& x) const {
        double out = 1;
        for (const std::size_t k : d.around)
            for (const int gone : {d.a, d.b}) {
                std::array<Vec3, 4> corners;
                for (int i = 0; i < 4; ++i) corners[i] = tetras_[k][i] == gone ? x : points_[tetras_[k][i]];
                out = std::min(out, mean_ratio(corners[0], corners[1], corners[2], corners[3]));
            }
        return out;
    }

    std::vector<Vec3>& points_;
    std::vector<Tetra>& tetras_;
    std::set<std::pair<int, int>> outer_;  // edges of the cavity's faces
};

}  // namespace

void mend_filling(std::vector<Vec3>& points, std::span<const Triangle> triangles, std::vector<Tetra>& tetras) {
    FillingMender(points, triangles, tetras).run();
}

}  // namespace femscalpel
