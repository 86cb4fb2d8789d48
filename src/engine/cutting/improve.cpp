// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/improve.h"

#include <cmath>
#include <utility>

#include "cancel.h"
#include "cutting/held_inside.h"
#include "cutting/mend_curved.h"
#include "cutting/merging.h"
#include "deformation/curved_shape.h"
#include "deformation/deformation.h"
#include "deformation/relaxation.h"
#include "mesh/quality.h"
#include "mesh/stopwatch.h"

namespace femscalpel {
namespace {

/// Elements worse than this get their longest edge bisected, in so many rounds at most.
constexpr double split_below = 0.35;
constexpr int split_rounds = 8;
/// Elements worse than this after relaxation are worked on further.
constexpr double improvement_goal = 0.45;

class Improver {
public:
    explicit Improver(Workpiece& f) : f_(f), d_(f.d), band_(f.d.band), merger_(f) {}

    /// Merges new nodes of bad elements away; true if any was.
    bool merge_nodes(double goal) {
        bool any = false;
        // A seam crosses every edge of narrow elements that lie side by side: of its nodes many have to go, also those
        // that were mid-side nodes. Elsewhere these stay the corners that they became.
        const bool is_seam = !f_.at_stop.empty();
        // A node is in many elements; what it could not do once it cannot again, unless something was merged nearby.
        std::vector<char> in_vain(static_cast<std::size_t>(band_.size()), 0);
        for (const auto& [quality, nodes] : bad_elements(goal))
            for (const int p : nodes) {
                if (p < 0 || in_vain[p] || !band_.is_new(p) || (band_.nodes[p].global >= 0 && !is_seam)) continue;
                const int target = merger_.merge(p);
                in_vain[p] = 1;
                if (target < 0) continue;
                any = true;
                touched_.push_back(target);
                for (const int v : band_.nodes_near({target}, 3)) in_vain[v] = 0;
            }
        return any;
    }

    /// Bisects the longest edge of each bad element; true if any was.
    bool split_long_edges(double limit) {
        bool any = false;
        std::size_t allowance = 16 + f_.nodes.size() / 8;
        for (const auto& [quality, v] : bad_elements(limit)) {
            check_cancelled();
            if (allowance-- == 0 || band_.tetras.size() + band_.triangles.size() >= f_.most_elements) break;
            const int corners = v[3] < 0 ? 3 : 4;
            int a = -1, b = -1;
            double longest = 0;
            for (int i = 0; i < corners; ++i)
                for (int j = 0; j < i; ++j) {
                    const double length = (band_.nodes[v[i]].at - band_.nodes[v[j]].at).squaredNorm();
                    if (length > longest && (band_.nodes[v[i]].movable() || band_.nodes[v[j]].movable()) &&
                        !d_.constraints.has_fixed_middle(v[i], v[j]) &&
                        !d_.constraints.is_related_edge(band_, v[i], v[j])) {
                        longest = length;
                        a = v[i];
                        b = v[j];
                    }
                }
            // An earlier split of this round may have taken the edge.
            if (a < 0 || !(in_one(band_.tetras, a, b) || in_one(band_.triangles, a, b))) continue;
            const Contact tools = d_.edge_contact(a, b);
            const auto [at, fits, worst] = d_.fitted_split(a, b, d_.along_edge(a, b, 0.5), tools);
            const bool bent = !d_.constraints.is_straight(d_.constraints.on_edge(band_, a, b));
            // Off its tool a node would be off it for good.
            if (((bent || tools) && !fits) || curved_children(d_, a, b, at, tools) < curved_limit) continue;
            touched_.push_back(f_.split_edge(a, b, at, tools));
            any = true;
        }
        return any;
    }

    /// The nodes that were born, and those that others were merged into, since the last call.
    std::vector<int> changes() { return std::exchange(touched_, {}); }

    /// Whether most elements of the band are worse than `limit`.
    bool most_below(double limit) const {
        int below = 0, all = 0;
        for (int t = 0; t < band_.tetras.size(); ++t)
            if (band_.tetras.alive(t)) {
                ++all;
                below += tetra_is_below(limit, d_, t);
            }
        return 2 * below > all;
    }

    /// How much the elements worse than `limit` lack, squared so that the worst weigh most.
    double shortfall(double limit) const {
        double sum = 0;
        for (const auto& [quality, nodes] : bad_elements(limit)) sum += (limit - quality) * (limit - quality);
        return sum;
    }

private:
    using Element = std::pair<double, std::array<int, 4>>;

    std::vector<Element> bad_elements(double goal) const {
        check_cancelled();
        std::vector<Element> bad;
        for (int t = 0; t < band_.tetras.size(); ++t)
            if (band_.tetras.alive(t) && tetra_is_below(goal, d_, t))
                bad.push_back({tetra_quality(d_, t), band_.tetras[t]});
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (band_.triangles.alive(t) && d_.constraints.is_shell(band_.triangles.origin(t)))
                if (const double q = shell_quality(d_, t); q < goal) {
                    const auto& v = band_.triangles[t];
                    bad.push_back({q, {v[0], v[1], v[2], -1}});
                }
        std::ranges::sort(bad);
        return bad;
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    NodeMerger merger_;
    std::vector<int> touched_;  // nodes born, and nodes others were merged into
};

/// Nodes born on a curved skin or tool where the curve would have spoiled an element lie on the chord at first. Now
/// that the band is relaxed, brings them onto their surface or curve; those that moved.
std::vector<int> fit_to_shapes(Workpiece& f) {
    Deformable& d = f.d;
    std::vector<int> moved;
    for (int v = d.band.original_nodes(); v < d.band.size(); ++v) {
        if (!d.band.in_use(v) || (d.constraints[v].freedom == NodeFreedom::free && !d.contact[v])) continue;
        Vec3 x = d.band.nodes[v].at;
        if (d.constraints.distance(d.constraints[v], x) <= 1e-6 * d.band.mean_edge_length(v) &&
            d.off_tools(v) <= f.tolerance)
            continue;
        if (!d.constraints.project(v, d.contact[v], x) || x == d.band.nodes[v].at || d.is_barred(v, x)) continue;
        if (quality_around(d, v, x) < std::min(0.1, quality_around(d, v, d.band.nodes[v].at))) continue;
        d.band.nodes[v].at = x;
        moved.push_back(v);
    }
    return moved;
}

}  // namespace

void improve(Workpiece& f, double goal) {
    Improver improver(f);
    // Where borders are everywhere, or the mesh is thin in one direction, most elements are too poor ever to be left
    // alone: only what changed can gain.
    const bool locally = held_inside(f).nearly_all_on_borders() || improver.most_below(goal);
    const auto relax_again = [&] { relax_near(f, improver.changes(), locally); };
    const auto may_go_on = [&] { return f.d.visits < f.most_visits; };
    for (int round = 0; round < 4 && may_go_on() && improver.merge_nodes(goal); ++round) relax_again();
    // Splitting must pay: two rounds without gain end it.
    double best = improver.shortfall(split_below);
    for (int round = 0, idle = 0;
         round < split_rounds && idle < 2 && may_go_on() && improver.split_long_edges(split_below); ++round) {
        relax_again();
        if (improver.merge_nodes(goal)) relax_again();
        const double now = improver.shortfall(split_below);
        idle = now < 0.95 * best ? 0 : idle + 1;
        best = std::min(best, now);
    }
}

void relax_band(Workpiece& f) {
    Stopwatch watch(f.seconds);
    find_node_sets(f);
    deform(f.d, f.nodes, f.transition);
    if (!f.released.empty()) relax(f.d, movable_nodes(f));
    watch.lap("deform");
    improve(f, improvement_goal);
    for (int round = 0; round < 3; ++round) {
        const std::vector<int> moved = fit_to_shapes(f);
        if (moved.empty()) break;
        relax_near(f, moved);
    }
    mend_curved(f);
    watch.lap("improve");
}

}  // namespace femscalpel
