// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/improve.h"

#include <cmath>
#include <utility>

#include "cancel.h"
#include "cutting/held_inside.h"
#include "cutting/mend_curved.h"
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
    explicit Improver(Workpiece& f) : f_(f), d_(f.d), band_(f.d.band) {}

    /// Merges new nodes of bad elements away; true if any was.
    bool merge_nodes(double goal) {
        bool any = false;
        // A node is in many elements; what it could not do once it cannot again, unless something was merged nearby.
        std::vector<char> in_vain(static_cast<std::size_t>(band_.size()), 0);
        for (const auto& [quality, nodes] : bad_elements(goal))
            for (const int p : nodes) {
                if (p < 0 || in_vain[p] || !band_.is_new(p) || band_.nodes[p].global >= 0) continue;
                const int target = try_merge(p);
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
            if (a < 0 || !(joined(band_.tetras, a, b) || joined(band_.triangles, a, b))) continue;
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

    template <std::size_t N>
    static bool joined(const SimplexList<N>& list, int a, int b) {
        return std::ranges::any_of(list.around(a),
                                   [&](int s) { return std::ranges::find(list[s], b) != list[s].end(); });
    }

    /// Whether moving p onto t keeps everything p stands for.
    bool may_merge(int p, int t) {
        // Where tools cross, nodes stay; on one tool the edge p-t must run in it.
        if (d_.contact[p].count() > 1 || !d_.contact[t].includes(d_.contact[p])) return false;
        if (!band_.cut_faces.around(p).empty() && !joined(band_.cut_faces, p, t)) return false;
        if (!band_.cut_edges.around(p).empty() && !joined(band_.cut_edges, p, t)) return false;
        const NodeConstraint& c = d_.constraints[p];
        if (d_.constraints.is_related(p) && !band_.skin.around(p).empty()) return false;
        // On a surface or crease the edge p-t itself must run in it.
        if (!band_.creases.around(p).empty()) {
            if (c.freedom != NodeFreedom::curve || !joined(band_.creases, p, t)) return false;
        } else if (!band_.skin.around(p).empty() && !joined(band_.skin, p, t)) {
            return false;
        }
        if (!band_.lines.around(p).empty() && !joined(band_.lines, p, t)) return false;
        if (f_.patched && closes(p, t)) return false;
        return !d_.membership.merge_links(band_, p, t);
    }

    /// Whether, with p moved onto t, all nodes of a face or edge of a bounded crack would be on its front: it could not
    /// open.
    bool closes(int p, int t) const {
        const auto on_front = [&](int v) { return d_.contact[v].count() > 1; };
        if (!on_front(t)) return false;
        const auto any_closed = [&](const auto& list) {
            return std::ranges::any_of(list.around(p), [&](int s) {
                const auto& nodes = list[s];
                return std::ranges::find(nodes, t) == nodes.end() &&
                       std::ranges::all_of(nodes, [&](int v) { return v == p || on_front(v); });
            });
        };
        // So would the crack's mouth, were its only node between two of the front to go.
        for (const int s : band_.cut_faces.around(p))
            for (const int w : band_.cut_faces[s])
                if (w != p && w != t && on_front(w) && band_.is_cut_border(p, w) &&
                    d_.constraints.is_skin_edge(band_, p, w))
                    return true;
        return any_closed(band_.cut_faces) || any_closed(band_.cut_edges);
    }

    /// Link condition: every node next to both p and t forms a triangle (tetrahedron face) with them.
    bool link_is_sound(int p, int t) {
        band_.neighbours(p, near_p_);
        band_.neighbours(t, near_t_);
        common_.clear();
        std::ranges::set_intersection(near_p_, near_t_, std::back_inserter(common_));
        for (const int w : common_) {
            const auto holds = [&](const auto& list) {
                return std::ranges::any_of(list.around(p), [&](int s) {
                    return std::ranges::find(list[s], t) != list[s].end() &&
                           std::ranges::find(list[s], w) != list[s].end();
                });
            };
            if (!holds(band_.tetras) && !holds(band_.triangles)) return false;
        }
        // The same on surfaces and creases, whose own links are smaller.
        for (const int w : common_) {
            const auto on_surface = [&](int a, int b) {
                return joined(band_.skin, a, b) || joined(band_.cut_faces, a, b);
            };
            if (on_surface(p, w) && on_surface(t, w) && on_surface(p, t) && band_.skin.find({p, t, w}) < 0 &&
                band_.cut_faces.find({p, t, w}) < 0)
                return false;
            if (joined(band_.creases, p, w) && joined(band_.creases, t, w)) return false;
            if (joined(band_.cut_edges, p, w) && joined(band_.cut_edges, t, w)) return false;
        }
        return true;
    }

    double quality_merged(int p, int t) const {
        const Vec3& at = band_.nodes[t].at;
        double worst = 1;
        const auto point = [&](int v) -> const Vec3& { return v == p ? at : band_.nodes[v].at; };
        for (const int s : band_.tetras.around(p)) {
            const auto& v = band_.tetras[s];
            if (std::ranges::find(v, t) == v.end())
                worst = std::min(worst, mean_ratio(point(v[0]), point(v[1]), point(v[2]), point(v[3])));
        }
        for (const int s : band_.triangles.around(p)) {
            const auto& v = band_.triangles[s];
            if (std::ranges::find(v, t) != v.end() || !d_.constraints.is_shell(band_.triangles.origin(s))) continue;
            const double turned = (point(v[1]) - point(v[0]))
                                      .cross(point(v[2]) - point(v[0]))
                                      .dot(d_.shell_normals[band_.triangles.origin(s)]);
            worst = std::min(worst, std::copysign(mean_ratio(point(v[0]), point(v[1]), point(v[2])), turned));
        }
        return worst;
    }

    /// Merges p into the neighbour that makes the elements around it best; that neighbour, or -1 if none makes them
    /// better.
    int try_merge(int p) {
        check_cancelled();
        if (band_.tetras.around(p).empty() && band_.triangles.around(p).empty()) return -1;
        band_.neighbours(p, candidates_);
        double best = quality_around(d_, p, band_.nodes[p].at) + 1e-3;
        int target = -1;
        for (const int t : candidates_) {
            if (!may_merge(p, t)) continue;
            const double q = quality_merged(p, t);
            if (q > best && link_is_sound(p, t) && curved_merged(d_, p, t) >= curved_limit) {
                best = q;
                target = t;
            }
        }
        if (target < 0) return -1;
        band_.merge_node(p, target);
        d_.contact[p] = {};
        return target;
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    std::vector<int> near_p_, near_t_, common_, candidates_;
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
