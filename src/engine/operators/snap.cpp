// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <sstream>

#include "deformation/curved_shape.h"
#include "deformation/deformation.h"
#include "mesh/quality.h"
#include "operators/improve.h"
#include "operators/interface.h"
#include "operators/mend_curved.h"
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

/// A new node may be this many edge lengths off the curved surface or curve it was born on.
constexpr double largest_misfit = 5e-4;
/// How often cutting a curved mesh is tried, each time with more nodes left alone.
constexpr int attempts = 8;

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
            if (f_.distance[v] >= 0) continue;
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

    /// Whether, with v on the tool, a face of a curved skin (a segment of a curved line) would lie on it with all its
    /// nodes: the tool nearly touches the skin there, and curved elements have no room between the two.
    bool would_lie_flat(int v) const {
        if (!d_.mids.any()) return false;
        const auto rest_lies = [&](const auto& nodes) {
            return std::ranges::all_of(nodes, [&](int w) { return w == v || d_.contact[w]; });
        };
        return std::ranges::any_of(band_.skin.around(v), [&](int s) { return !d_.constraints.is_flat(band_.skin.tag(s)) && rest_lies(band_.skin[s]); }) ||
               std::ranges::any_of(band_.creases.around(v), [&](int s) {
                   return !d_.constraints.is_straight(d_.constraints.on_edge(band_, band_.creases[s][0], band_.creases[s][1])) && rest_lies(band_.creases[s]);
               });
    }

    void snap(int v, double length, double ratio) {
        if (d_.off_tool[v] || would_lie_flat(v)) return;
        BandNode& node = band_.nodes[v];
        Vec3 target = node.at;
        if (!d_.constraints.project(v, &tool_, target)) {
            if (ratio > forced_reach) return;
            target = tool_.project(node.at);
        }
        if ((target - node.at).norm() > std::min(snap_slide * length, d_.constraints.leash(v))) return;
        const double before = quality_around(d_, v, node.at);
        const double after = quality_around(d_, v, target);
        if (!(after >= std::min(0.1, before / 4)) || !(after > 0) || !keeps_curved_shape(d_, v, target)) return;
        node.at = target;
        d_.contact[v] = &tool_;
        f_.distance[v] = 0;
    }

    /// The point of the edge a-b on the tool, and on the surface or curve the edge is on.
    Vec3 crossing(int a, int b) const {
        const Vec3 &pa = band_.nodes[a].at, &pb = band_.nodes[b].at;
        double ta = 0, tb = 1, da = f_.distance[a], db = f_.distance[b];
        Vec3 at = pa;
        // Regula falsi, Illinois variant; exact in one step for a plane and a straight edge.
        for (int i = 0; i < 60; ++i) {
            const double t = ta + (tb - ta) * da / (da - db);
            at = d_.along_edge(a, b, t);
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
        const Deformable::SplitPoint bent = d_.fitted_split(a, b, at, &tool_);
        if (bent.fits && bent.worst > 0) return bent.at;
        // On the chord elements stay sound; the surface has to wait.
        const double t = f_.distance[a] / (f_.distance[a] - f_.distance[b]);
        return tool_.project(pa + t * (pb - pa));
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

/// Elements of the input (slots) in which new nodes are off the curved skin they were born on, or parts came out as folded
/// second-order elements.
std::vector<int> misfits(const Interface& f) {
    const BandMesh& band = f.d.band;
    std::vector<int> found;
    const auto note = [&](int t) { found.push_back(band.tetras.origin(t)); };
    std::ranges::for_each(folded_elements(f, least_curved), note);
    for (int v = band.original_nodes(); v < band.size(); ++v)
        if (band.in_use(v) && f.d.constraints.distance(f.d.constraints[v], band.nodes[v].at) > largest_misfit * band.mean_edge_length(v))
            std::ranges::for_each(band.tetras.around(v), note);
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

/// Bisects the edges of some elements (slots of the input), longest first. Halves bulge a quarter as far, so that a tool
/// finds room between a curved skin and its chords where it found none.
void refine(Interface& f, const std::vector<int>& origins, const Tool& tool) {
    BandMesh& band = f.d.band;
    std::vector<std::tuple<double, int, int>> edges;
    for (int t = 0; t < band.tetras.size(); ++t) {
        if (!band.tetras.alive(t) || !std::ranges::binary_search(origins, band.tetras.origin(t))) continue;
        for (const int a : band.tetras[t])
            for (const int b : band.tetras[t])
                if (a < b && (band.nodes[a].movable() || band.nodes[b].movable())) edges.push_back({-(band.nodes[a].at - band.nodes[b].at).norm(), a, b});
    }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [length, a, b] : edges) {
        // With both ends on the tool the halves would have to be, too.
        if (f.d.contact[a].common(f.d.contact[b])) continue;
        const Vec3 at = f.d.along_edge(a, b, 0.5);
        f.d.split_edge(a, b, at, {});
        f.distance.push_back(tool.distance(at));
    }
}

[[noreturn]] void fail_at(const Interface& f, int slot, const Tool& tool) {
    Vec3 middle = Vec3::Zero();
    for (const int v : f.d.band.tetras[slot]) middle += f.d.band.nodes[v].start / 4;
    std::ostringstream text;
    text << "no sound elements were found on the curved skin near (" << middle.transpose() << "): the mesh is too coarse for the way the " << tool.kind()
         << " meets the skin there. Move the " << tool.kind() << " a little, or refine the mesh";
    throw QualityError(text.str());
}

void snap_once(Interface& f, const Tool& tool) {
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
    mend_curved(f, tool);
    watch.lap("improve");
}

}  // namespace

void snap_to_tool(Interface& f, const Tool& tool) {
    if (!f.d.mids.any() && !f.d.constraints.any_curved()) return snap_once(f, tool);
    Interface start = f;
    for (int attempt = 1;; ++attempt) {
        snap_once(f, tool);
        const std::vector<int> bad = misfits(f);
        if (bad.empty()) return;
        if (attempt == attempts) fail_at(f, bad[0], tool);
        // First these elements' nodes are not put on the tool, then the elements are refined.
        std::vector<char>& off_tool = start.d.off_tool;
        if (attempt % 2 == 1) {
            for (int t = 0; t < start.d.band.tetras.size(); ++t)
                if (start.d.band.tetras.alive(t) && std::ranges::binary_search(bad, start.d.band.tetras.origin(t)))
                    for (const int v : start.d.band.tetras[t]) off_tool[v] = 1;
        } else {
            refine(start, bad, tool);
            std::ranges::fill(off_tool, 0);
        }
        const auto seconds = f.seconds;
        f = start;
        f.seconds = seconds;
    }
}

}  // namespace femscalpel
