// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/mend_curved.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cancel.h"
#include "deformation/curved_shape.h"

namespace femscalpel {
namespace {

/// Elements below this are worked on.
constexpr double goal = 0.1;
constexpr int rounds = 6;
/// An edge whose mid-side node is farther off its chord than this, in lengths of it, may be bisected.
constexpr double far_bulge = 0.04;
/// A search for a corner's place is as much work as so many Deformable::visits; mending may take it to so many times
/// what all of an operation is bounded by.
constexpr long visits_of_search = 6;
constexpr double most_of_work = 1.5;

class Mender {
public:
    Mender(Workpiece& f, bool may_split) : f_(f), d_(f.d), band_(f.d.band), may_split_(may_split) {}

    void run() {
        for (int round = 0; round < rounds; ++round) {
            const std::vector<BandElement> bad = folded_elements(f_, goal);
            if (bad.empty()) return;
            for (const BandElement e : bad) {
                check_cancelled();
                // Where so many are folded that it takes longer than all else, mending is not what helps.
                if (d_.visits / most_of_work >= f_.most_visits) return;
                if (!e.alive(band_) || curved_shape(d_, e) >= goal) continue;
                flatten_edges(e);
                if (curved_shape(d_, e) < goal) move_nodes(e);
                if (may_split_ && curved_shape(d_, e) < goal && round % 2 == 1) split_edge(e);
            }
        }
    }

private:
    double worst_around_edge(int a, int b) const {
        double worst = 1;
        for_second_order_at_edge(d_, a, b, [&](BandElement e) { worst = std::min(worst, curved_shape(d_, e)); });
        return worst;
    }

    bool is_untouched(int a, int b) const {
        return !band_.is_new(a) && !band_.is_new(b) && band_.nodes[a].at == band_.nodes[a].start &&
               band_.nodes[b].at == band_.nodes[b].start;
    }

    /// Mid-side nodes to the middle of their edges.
    void flatten_edges(BandElement e) {
        const auto nodes = e.nodes(band_);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const int a = nodes[i], b = nodes[j];
                const Vec3 bulge = d_.mids.bulge(a, b);
                if (bulge.isZero(0) || is_untouched(a, b)) continue;
                const double before = worst_around_edge(a, b);
                d_.mids.set_bulge(a, b, Vec3::Zero());
                if (worst_around_edge(a, b) <= before) d_.mids.set_bulge(a, b, bulge);
            }
    }

    double merit(CurvedStar& star, int v, const Vec3& x) {
        const double straight = quality_around(d_, v, x);
        // Worse than any fold: an element that is inverted by its corners is never sound.
        if (!(straight > 0)) return -std::numeric_limits<double>::infinity();
        return std::min(star.worst(x) / (2 * goal), std::min(1.0, straight / 0.3));
    }

    /// Pattern search for each corner.
    void move_nodes(BandElement e) {
        for (const int v : e.nodes(band_)) {
            if (!band_.nodes[v].movable()) continue;
            CurvedStar star(d_, v);
            double best = merit(star, v, band_.nodes[v].at);
            if (best >= 1) continue;
            d_.visits += visits_of_search;
            const double length = band_.mean_edge_length(v);
            for (double step = 0.24 * length; step > 0.02 * length; step /= 2) {
                Eigen::Matrix3d basis;
                const int freedom = d_.constraints.tangents(v, d_.contact[v], band_.nodes[v].at, basis);
                for (int k = 0; k < 2 * freedom; ++k) {
                    Vec3 x = band_.nodes[v].at + (k % 2 ? -step : step) * basis.col(k / 2);
                    if (!d_.constraints.project(v, d_.contact[v], x) || d_.is_barred(v, x)) continue;
                    if ((x - band_.nodes[v].at).norm() > 2 * step) continue;
                    const double now = merit(star, v, x);
                    if (now <= best + 1e-3) continue;
                    best = now;
                    band_.nodes[v].at = x;
                }
            }
        }
    }

    /// Bisects the edge that bulges most: halves have a quarter of the bulge.
    void split_edge(BandElement e) {
        const auto nodes = e.nodes(band_);
        double farthest = far_bulge;
        int a = -1, b = -1;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const Vec3 &x = band_.nodes[nodes[i]].at, &y = band_.nodes[nodes[j]].at;
                const MidSide mid = mid_side(d_, nodes[i], nodes[j]);
                const double bulge = (mid.at - (x + y) / 2).norm() / (x - y).norm();
                if (!mid.fits || bulge <= farthest ||
                    !(band_.nodes[nodes[i]].movable() || band_.nodes[nodes[j]].movable()))
                    continue;
                farthest = bulge;
                a = nodes[i];
                b = nodes[j];
            }
        if (a < 0) return;
        const Contact tools = edge_tools(d_, a, b);
        const Deformable::SplitPoint point = d_.fitted_split(a, b, d_.along_edge(a, b, 0.5), tools);
        if (!point.fits || !(point.worst > 0.02)) return;
        f_.split_edge(a, b, point.at, tools);
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    bool may_split_;
};

}  // namespace

std::vector<BandElement> folded_elements(const Workpiece& f, double limit) {
    const BandMesh& band = f.d.band;
    std::vector<std::tuple<double, bool, int>> found;
    if (!f.d.mids.any()) return {};
    for (const bool triangle : {false, true})
        for (int s = 0; s < (triangle ? band.triangles.size() : band.tetras.size()); ++s) {
            const BandElement e{triangle, s};
            if (!e.alive(band)) continue;
            const bool changed = e.is_changed(band) || std::ranges::any_of(e.nodes(band), [&](int v) {
                                     return static_cast<bool>(f.d.contact[v]);
                                 });
            if (!changed || (limit <= curved_limit && is_surely_sound(f.d, e))) continue;
            if (const double ratio = curved_shape(f.d, e); ratio < limit) found.push_back({ratio, triangle, s});
        }
    std::ranges::sort(found);
    std::vector<BandElement> out;
    out.reserve(found.size());
    for (const auto& [ratio, triangle, slot] : found) out.push_back({triangle, slot});
    return out;
}

void mend_curved(Workpiece& f, bool may_split) {
    if (f.d.mids.any()) Mender(f, may_split).run();
}

}  // namespace femscalpel
