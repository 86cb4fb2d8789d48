// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>

#include "deformation/deformation.h"
#include "mesh/quality.h"
#include "operators/improve.h"
#include "operators/interface.h"
#include "operators/stopwatch.h"

namespace femscalpel {
namespace {

/// A node farther than this from the tool, in local edge lengths, is not moved onto it.
constexpr double snap_reach = 0.45;
/// Sliding along a slanting surface may take it farther, up to this.
constexpr double snap_slide = 1.0;
/// Elements worse than this after relaxation are worked on further.
constexpr double improvement_goal = 0.45;
/// A node on a corner or a crease may be off the tool by this many edge lengths and still be put on it:
/// far below what a measure of a group would notice.
constexpr double forced_reach = 1e-7;

class Snapper {
public:
    Snapper(Interface& interface, const Tool& tool) : f_(interface), d_(interface.d), band_(interface.d.band), tool_(tool) {}

    void snap_nodes() {
        struct Candidate {
            double ratio;
            int node;
            double length;
        };
        std::vector<Candidate> candidates;
        for (int v = 0; v < band_.size(); ++v) {
            if (d_.contact[v] || band_.nodes[v].level != 0 || !crosses(v)) continue;
            const double length = band_.mean_edge_length(v);
            const double ratio = std::abs(f_.distance[v]) / length;
            if (ratio < snap_reach) candidates.push_back({ratio, v, length});
        }
        std::ranges::sort(candidates, [](const Candidate& x, const Candidate& y) {
            return std::pair(x.ratio, x.node) < std::pair(y.ratio, y.node);
        });
        for (const Candidate& c : candidates)
            if (crosses(c.node)) snap(c.node, c.length, c.ratio);
    }

    void split_edges() {
        struct Edge {
            double length;
            int a, b;
        };
        std::vector<Edge> edges;
        for (int v = 0; v < band_.size(); ++v) {
            if (f_.distance[v] >= 0 || !crosses(v)) continue;
            band_.neighbours(v, neighbours_);
            for (const int w : neighbours_)
                if (f_.distance[w] > 0 && divides(v, w)) edges.push_back({(band_.nodes[v].at - band_.nodes[w].at).norm(), v, w});
        }
        std::ranges::sort(edges, [](const Edge& x, const Edge& y) {
            return x.length != y.length ? x.length > y.length : std::pair(x.a, x.b) < std::pair(y.a, y.b);
        });
        for (const Edge& e : edges) {
            const Vec3 at = crossing(e.a, e.b);
            d_.split_edge(e.a, e.b, at, &tool_);
            f_.distance.push_back(0);
        }
    }

private:
    /// Whether an edge to cut joins the two nodes: one of a triangle or tetrahedron.
    bool divides(int v, int w) const {
        const auto holds = [&](const auto& list) {
            return std::ranges::any_of(list.around(v), [&](int s) { return std::ranges::find(list[s], w) != list[s].end(); });
        };
        return holds(band_.tetras) || holds(band_.triangles);
    }

    bool crosses(int v) const {
        const double side = f_.distance[v];
        const auto opposite = [&](const auto& list) {
            return std::ranges::any_of(list.around(v), [&](int s) {
                return std::ranges::any_of(list[s], [&](int w) { return f_.distance[w] * side < 0; });
            });
        };
        return opposite(band_.tetras) || opposite(band_.triangles);
    }

    void snap(int v, double length, double ratio) {
        BandNode& node = band_.nodes[v];
        Vec3 target = node.at;
        if (!d_.constraints.project(v, &tool_, target)) {
            if (ratio > forced_reach) return;
            target = tool_.project(node.at);
        }
        if ((target - node.at).norm() > std::min(snap_slide * length, d_.constraints.leash(v))) return;
        const double before = quality_around(d_, v, node.at);
        const double after = quality_around(d_, v, target);
        if (!(after >= std::min(0.1, before / 4)) || !(after > 0)) return;
        node.at = target;
        d_.contact[v] = &tool_;
        f_.distance[v] = 0;
    }

    /// The point of the edge a-b on the tool, moved along the tool onto the surface or curve the edge is on.
    Vec3 crossing(int a, int b) const {
        const Vec3 &pa = band_.nodes[a].at, &pb = band_.nodes[b].at;
        double ta = 0, tb = 1, da = f_.distance[a], db = f_.distance[b];
        Vec3 at = pa;
        // Regula falsi, Illinois variant; exact in one step for a plane.
        for (int i = 0; i < 60; ++i) {
            const double t = ta + (tb - ta) * da / (da - db);
            at = pa + t * (pb - pa);
            const double dt = tool_.distance(at);
            if (std::abs(dt) <= 1e-3 * f_.tolerance) break;
            if ((dt < 0) == (da < 0)) {
                ta = t;
                da = dt;
                db /= 2;
            } else {
                tb = t;
                db = dt;
                da /= 2;
            }
        }
        return d_.fitted_split(a, b, at, &tool_);
    }

    Interface& f_;
    Deformable& d_;
    BandMesh& band_;
    const Tool& tool_;
    std::vector<int> neighbours_;
};

/// Nodes born on a curved skin where the curve would have spoiled an element lie on the chord at first. Now
/// that the band is relaxed, brings them onto their surface or curve; true if any moved.
bool fit_to_shapes(Deformable& d) {
    bool any = false;
    for (int v = d.band.original_nodes(); v < d.band.size(); ++v) {
        if (!d.band.in_use(v) || d.constraints[v].freedom == NodeFreedom::free) continue;
        Vec3 x = d.band.nodes[v].at;
        if (d.constraints.distance(d.constraints[v], x) <= 1e-6 * d.band.mean_edge_length(v)) continue;
        if (!d.constraints.project(v, d.contact[v], x) || d.is_barred(v, x)) continue;
        if (quality_around(d, v, x) < std::min(0.1, quality_around(d, v, d.band.nodes[v].at))) continue;
        d.band.nodes[v].at = x;
        any = true;
    }
    return any;
}

void warn_of_misfits(Interface& f) {
    int count = 0;
    double worst = 0;
    for (int v = f.d.band.original_nodes(); v < f.d.band.size(); ++v) {
        if (!f.d.band.in_use(v)) continue;
        const double off = f.d.constraints.distance(f.d.constraints[v], f.d.band.nodes[v].at) / f.d.band.mean_edge_length(v);
        count += off > 1e-3;
        worst = std::max(worst, off);
    }
    if (count > 0)
        f.warnings.push_back(std::to_string(count) + " new node(s) lie off the curved skin by up to " + std::to_string(worst) +
                             " edge lengths: on it, elements would be flat");
}

}  // namespace

void snap_to_tool(Interface& f, const Tool& tool) {
    Stopwatch watch(f.seconds);
    Snapper snapper(f, tool);
    snapper.snap_nodes();
    watch.lap("snap");
    snapper.split_edges();
    watch.lap("split");
    f.d.barrier = &tool;
    for (int v = 0; v < f.d.band.size(); ++v)
        f.d.side[v] = static_cast<signed char>((f.distance[v] > 0) - (f.distance[v] < 0));
    find_node_sets(f);
    deform(f.d, f.nodes, f.transition);
    watch.lap("deform");
    improve(f, tool, improvement_goal);
    for (int round = 0; round < 3 && fit_to_shapes(f.d); ++round) {
        find_node_sets(f);
        std::vector<int> movable = f.nodes;
        movable.insert(movable.end(), f.transition.begin(), f.transition.end());
        relax(f.d, movable);
    }
    warn_of_misfits(f);
    watch.lap("improve");
}

}  // namespace femscalpel
