// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/straighten.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

#include "cancel.h"
#include "cutting/folded_input.h"
#include "cutting/mend_curved.h"
#include "deformation/curved_shape.h"
#include "words.h"

namespace femscalpel {
namespace {

/// Elements are straightened until they are this good, or straight.
constexpr double goal = 0.1;
/// Straightening spreads from element to element at most so often.
constexpr int rounds = 12;
/// What is nearer to its surface or curve, in edge lengths, is on it as well as anything.
constexpr double on_it = 5e-4;

class Straightener {
public:
    explicit Straightener(Workpiece& f) : f_(f), d_(f.d), band_(f.d.band) {}

    bool run() {
        for (int round = 0; round < rounds; ++round) {
            check_cancelled();
            const std::vector<BandElement> bad = folded();
            if (bad.empty()) return look_at_nodes() && say();
            for (const BandElement e : bad)
                if (!straighten(e)) return false;
        }
        return false;
    }

private:
    std::vector<BandElement> folded() const {
        std::vector<BandElement> out = newly_folded(f_, folded_elements(f_, least_curved));
        for (const auto& [key, wanted] : around_) {
            const BandElement e{key.first, key.second};
            if (curved_shape(d_, e) < wanted && std::ranges::find(out, e) == out.end()) out.push_back(e);
        }
        return out;
    }

    bool may_straighten(int a, int b) const {
        return (band_.nodes[a].movable() || band_.nodes[b].movable()) && !d_.mids.is_straightened(a, b) &&
               !d_.constraints.has_fixed_middle(a, b) && !d_.constraints.is_related_edge(band_, a, b);
    }

    /// Edges of an element that are not straight, in the order in which they are to become so.
    std::vector<std::array<int, 2>> bent_edges(BandElement e) const {
        std::vector<std::tuple<double, int, int>> found;
        const auto nodes = e.nodes(band_);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const int a = nodes[i], b = nodes[j];
                if (!may_straighten(a, b)) continue;
                const Vec3 &x = band_.nodes[a].at, &y = band_.nodes[b].at;
                const MidSide mid = mid_side(d_, a, b);
                const double bulge = mid.fits ? (mid.at - (x + y) / 2).norm() / (x - y).norm() : 1;
                if (bulge > 0) found.emplace_back(-bulge, a, b);
            }
        std::ranges::sort(found);
        std::vector<std::array<int, 2>> out;
        out.reserve(found.size());
        for (const auto& [bulge, a, b] : found) out.push_back({a, b});
        return out;
    }

    bool straighten(BandElement e) {
        if (curved_shape(d_, e) >= goal) return true;
        for (const auto& [a, b] : bent_edges(e)) {
            watch_around(a, b);
            const NodeConstraint on = d_.constraints.on_edge(band_, a, b);
            d_.mids.straighten(a, b);
            if (!note_middle(on, a, b)) return false;
            if (curved_shape(d_, e) >= goal) return true;
        }
        return curved_shape(d_, e) >= least_curved || leave_tools(e);
    }

    /// What straightening edges may spoil.
    void watch_around(int a, int b) {
        for_second_order_at_edge(d_, a, b, [&](BandElement other) {
            around_.try_emplace({other.triangle, other.slot}, std::min(curved_shape(d_, other), least_curved));
        });
    }

    /// Where an element has no room for the arcs that its edges on curved tools are: chords of these, as in first-order
    /// elements, those first that bulge most.
    bool leave_tools(BandElement e) {
        std::vector<std::tuple<double, int, int>> arcs;
        const auto nodes = e.nodes(band_);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const int a = nodes[i], b = nodes[j];
                if (!d_.mids.is_straightened(a, b) || d_.mids.is_off_tools(a, b)) continue;
                const double bulge = (mid_side(d_, a, b).at - (band_.nodes[a].at + band_.nodes[b].at) / 2).norm();
                if (bulge > 0) arcs.emplace_back(-bulge, a, b);
            }
        std::ranges::sort(arcs);
        for (const auto& [bulge, a, b] : arcs) {
            watch_around(a, b);
            const NodeConstraint on = d_.constraints.on_edge(band_, a, b);
            d_.mids.straighten_off_tools(a, b);
            if (!note_middle(on, a, b)) return false;
            if (curved_shape(d_, e) >= goal) return true;
        }
        return curved_shape(d_, e) >= least_curved;
    }

    bool note_middle(const NodeConstraint& on, int a, int b) {
        const Vec3 middle = mid_side(d_, a, b).at;
        const double off_tools = Deformable::off_tools(edge_tools(d_, a, b), middle, d_.held_between(a, b));
        return note(std::max(d_.constraints.distance(on, middle), off_tools), middle, length_at(a, b));
    }

    /// Of the edge, or of those around its ends, which may be beside the surface themselves.
    double length_at(int a, int b) const {
        return std::max(
            {(band_.nodes[a].at - band_.nodes[b].at).norm(), band_.mean_edge_length(a), band_.mean_edge_length(b)});
    }

    /// Nodes born on a curved surface or curve that could not be brought onto it.
    bool look_at_nodes() {
        for (int v = band_.original_nodes(); v < band_.size(); ++v) {
            if (!band_.in_use(v)) continue;
            if (d_.off_tools(v) > 10 * f_.tolerance) return false;
            const NodeConstraint& c = d_.constraints[v];
            if (d_.constraints.is_straight(c)
                    ? d_.constraints.distance(c, band_.nodes[v].at) > std::max(10 * f_.tolerance, d_.rounding)
                    : !note(d_.constraints.distance(c, band_.nodes[v].at), band_.nodes[v].at,
                            band_.mean_edge_length(v)))
                return false;
        }
        return true;
    }

    /// Notes what is `off` its surface, curve or tools; false if it is too far.
    bool note(double off, const Vec3& x, double length) {
        if (off <= std::max(on_it * length, d_.rounding)) return true;
        ++count_;
        f_.straightened_part = std::max(f_.straightened_part, off / length);
        if (off > farthest_) {
            farthest_ = off;
            place_ = x;
        }
        return off <= farthest_straightened * length;
    }

    bool say() {
        if (count_ == 0) return true;
        f_.straightened = std::max(f_.straightened, count_);
        f_.straightened_off = std::max(f_.straightened_off, farthest_);
        std::ostringstream text;
        text.precision(3);
        text << "curved elements find no room where the " << f_.tool->kind()
             << " passes a surface, where the mesh is coarse: " << counted(count_, "node was", "nodes were")
             << " left in the middle of straight edges, up to " << farthest_
             << " beside where they belong, farthest near (" << place_.transpose()
             << "). Refine the mesh there first, or move the " << f_.tool->kind();
        f_.warnings.push_back(text.str());
        return true;
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    std::map<std::pair<bool, int>, double> around_;  // what elements at straightened edges are to be at least
    Index count_ = 0;
    double farthest_ = 0;
    Vec3 place_ = Vec3::Zero();
};

}  // namespace

bool straighten_folded(Workpiece& f) { return Straightener(f).run(); }

}  // namespace femscalpel
