// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/beams.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "cancel.h"
#include "cutting/locate.h"
#include "cutting/root.h"
#include "deck/solver_sets.h"

namespace femscalpel {
namespace {

/// No beams shorter than this part of what they were are made.
constexpr double shortest_part = 1e-3;

/// The line of a beam, by reference coordinates from 0 to 1.
struct Course {
    Vec3 from, to, bulge;  ///< bulge: of the middle, off that of the ends

    Vec3 at(double t) const { return (1 - t) * from + t * to + 4 * t * (1 - t) * bulge; }
    /// No part of it is longer than its share of this.
    double speed() const { return std::max((to - from + 4 * bulge).norm(), (to - from - 4 * bulge).norm()); }
};

/// What parts of a curved tool's radius is searched for a way in and out.
constexpr double finest_part = 0.02;

/// Finds where a course passes from one side of a blade to the other.
class Passages {
public:
    Passages(const Course& course, const Blade& blade, double rounding)
        : course_(course),
          blade_(blade),
          rounding_(rounding),
          speed_(course.speed()),
          finest_(std::min(shortest_part, finest_part * blade.tool->feature_size() / speed_)) {}

    std::vector<double> find() {
        const double at_end = distance(1);
        search(0, 1, distance(0), at_end);
        seen_.push_back({1, at_end});
        std::vector<double> out;
        const Sample* before = nullptr;  // the last that is not on the tool
        const Sample* on = nullptr;      // the first on it since
        for (const Sample& s : seen_) {
            if (s.distance == 0) {
                if (!on) on = &s;
                continue;
            }
            if (before && before->distance * s.distance < 0) out.push_back(on ? on->at : between(*before, s));
            before = &s;
            on = nullptr;
        }
        std::erase_if(out, [&](double t) { return !is_wanted(course_.at(t)); });
        return out;
    }

private:
    struct Sample {
        double at, distance;
    };

    double distance(double t) const {
        const double d = blade_.tool->distance(course_.at(t));
        return std::abs(d) <= rounding_ ? 0 : d;
    }

    /// Notes the beginnings of parts in which nothing is missed, ascending: distances change by no more than one goes.
    void search(double low, double high, double at_low, double at_high) {
        const double length = speed_ * (high - low);
        const bool clear = at_low * at_high > 0 && std::abs(at_low) + std::abs(at_high) >= length;
        if (clear || high - low < finest_) {
            seen_.push_back({low, at_low});
            return;
        }
        const double middle = (low + high) / 2, at_middle = distance(middle);
        search(low, middle, at_low, at_middle);
        search(middle, high, at_middle, at_high);
    }

    double between(const Sample& low, const Sample& high) const {
        const double size = high.at - low.at;
        return low.at + size * root_between(low.distance, high.distance, 1e-3 * rounding_, [&](double t) {
                            return blade_.tool->distance(course_.at(low.at + t * size));
                        });
    }

    bool is_wanted(const Vec3& x) const {
        return (!blade_.bound || blade_.bound(x) <= rounding_) &&
               std::ranges::all_of(blade_.inside, [&](const Tool* t) { return t->distance(x) <= rounding_; });
    }

    const Course& course_;
    const Blade& blade_;
    double rounding_, speed_, finest_;
    std::vector<Sample> seen_;
};

class BeamFinder {
public:
    BeamFinder(const Mesh& mesh, std::span<const Blade> blades)
        : mesh_(mesh), blades_(blades), rounding_(reach_of_rounding(mesh).rounding) {}

    BeamCuts run() {
        find_candidates();
        if (candidates_.empty()) return {};
        drop_edges();
        for (const CellRef& c : candidates_) cut(c);
        std::ranges::sort(out_.stops);
        out_.stops.erase(std::unique(out_.stops.begin(), out_.stops.end()), out_.stops.end());
        return std::move(out_);
    }

private:
    std::span<const Index> nodes(const CellRef& c) const { return mesh_.block(c.type).nodes(c.cell); }
    const Vec3& at(Index n) const { return mesh_.points[n]; }

    std::vector<double> passages(const CellRef& c) const {
        const auto n = nodes(c);
        Course course{at(n[0]), at(n[1]), Vec3::Zero()};
        if (n.size() == 3) course.bulge = at(n[2]) - (course.from + course.to) / 2;
        std::vector<double> out;
        for (const Blade& b : blades_)
            std::ranges::copy(Passages(course, b, rounding_).find(), std::back_inserter(out));
        std::ranges::sort(out);
        // Where tools meet there is one node.
        const double same = 10 * rounding_ / course.speed();
        out.erase(std::unique(out.begin(), out.end(), [&](double a, double b) { return b - a <= same; }), out.end());
        return out;
    }

    /// Segments that tools pass through.
    void find_candidates() {
        const std::vector<char> whole = families_of_whole_elements(mesh_);
        SparseCheck check(64);
        for (const CellType type : {CellType::line, CellType::line3}) {
            const CellBlock& block = mesh_.block(type);
            for (Index c = 0; c < block.size(); ++c) {
                check();
                if (!whole.empty() && whole[block.families[c]]) continue;
                if (!passages({type, c}).empty()) candidates_.push_back({type, c});
            }
        }
    }

    /// Drops the edges of other elements.
    void drop_edges() {
        const auto key = [](Index a, Index b) { return edge_key(static_cast<int>(a), static_cast<int>(b)); };
        std::unordered_set<std::uint64_t> edges;
        std::vector<char> marked(mesh_.points.size(), 0);
        for (const CellRef& c : candidates_)
            for (const Index n : nodes(c).first(2)) marked[n] = 1;
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            if (t.dimension < 2) continue;
            SparseCheck check;
            for (Index c = 0; c < b.size(); ++c) {
                check();
                const auto n = b.nodes(c);
                for (const auto& e : t.edges)
                    if (marked[n[e[0]]] && marked[n[e[1]]]) edges.insert(key(n[e[0]], n[e[1]]));
            }
        }
        std::erase_if(candidates_, [&](const CellRef& c) { return edges.contains(key(nodes(c)[0], nodes(c)[1])); });
    }

    void cut(const CellRef& c) {
        const auto n = nodes(c);
        const std::vector<double> all = passages(c);
        BeamCut out{c, {}};
        for (const double t : all) {
            const double stop = n.size() == 3 ? std::round(2 * t) / 2 : std::round(t);
            const auto is_near = [&](double other) { return std::abs(other - stop) < shortest_part; };
            // What lies between two tools that are near the same node is not to be lost.
            if (!is_near(t) || std::ranges::count_if(all, is_near) > 1) {
                out.at.push_back(t);
                continue;
            }
            if (stop == 0.5) out.at.push_back(stop);
            out_.stops.push_back(stop == 0 ? n[0] : stop == 1 ? n[1] : n[2]);
        }
        if (!out.at.empty()) out_.cuts.push_back(std::move(out));
    }

    const Mesh& mesh_;
    std::span<const Blade> blades_;
    double rounding_;
    std::vector<CellRef> candidates_;
    BeamCuts out_;
};

}  // namespace

BeamCuts find_beam_cuts(const Mesh& mesh, std::span<const Blade> blades) {
    if (mesh.block(CellType::line).size() == 0 && mesh.block(CellType::line3).size() == 0) return {};
    return BeamFinder(mesh, blades).run();
}

}  // namespace femscalpel
