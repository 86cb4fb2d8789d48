// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <map>

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
/// An edge that dips this deep through a curved tool, in its own length, gets a node in between.
constexpr double dip = 0.15;

class Snapper {
public:
    /// `value`: signed distances to the blade's tool by band node, exactly 0 in contact.
    Snapper(Interface& interface, const Blade& blade, std::vector<double>& value)
        : f_(interface), d_(interface.d), band_(interface.d.band), blade_(blade), tool_(*blade.tool), value_(value) {
        find_region();
    }

    /// Nodes that already lie on the tool, where it is wanted.
    void touch_nodes() {
        for (int v = 0; v < band_.size(); ++v) {
            if (std::abs(value_[v]) > f_.tolerance || d_.contact[v].has(&tool_) || d_.contact[v].full() || !in_region(v)) continue;
            d_.contact[v] = d_.contact[v].with(&tool_);
            value_[v] = 0;
        }
    }

    /// Halves edges that dip through a curved tool between two ends on the same side.
    void split_dipping_edges() {
        if (!std::isfinite(tool_.feature_size())) return;
        std::vector<Edge> edges = region_edges([&](int a, int b) {
            if (value_[a] * value_[b] <= 0) return false;
            const Vec3 middle = (band_.nodes[a].at + band_.nodes[b].at) / 2;
            const double length = (band_.nodes[a].at - band_.nodes[b].at).norm();
            if (std::min(std::abs(value_[a]), std::abs(value_[b])) > length) return false;
            return tool_.distance(middle) * (value_[a] > 0 ? -1 : 1) > dip * length;
        });
        for (const Edge& e : edges) {
            const Contact tools = d_.edge_contact(e.a, e.b);
            split(e.a, e.b, d_.fitted_split(e.a, e.b, (band_.nodes[e.a].at + band_.nodes[e.b].at) / 2, tools), tools);
        }
        if (!edges.empty()) find_region();
    }

    void snap_nodes() {
        struct Candidate {
            double ratio;
            int node;
            double length;
        };
        std::vector<Candidate> candidates;
        for (int v = 0; v < band_.size(); ++v) {
            if (d_.contact[v].has(&tool_) || d_.contact[v].full() || band_.nodes[v].level != 0 || !crosses(v)) continue;
            const double length = band_.mean_edge_length(v);
            const double ratio = std::abs(value_[v]) / length;
            if (ratio < snap_reach) candidates.push_back({ratio, v, length});
        }
        std::ranges::sort(candidates, [](const Candidate& x, const Candidate& y) {
            return std::pair(x.ratio, x.node) < std::pair(y.ratio, y.node);
        });
        for (const Candidate& c : candidates)
            if (crosses(c.node)) snap(c.node, c.length, c.ratio);
    }

    void split_edges() {
        for (const Edge& e : region_edges([&](int a, int b) { return value_[a] * value_[b] < 0; })) {
            const Contact tools = d_.edge_contact(e.a, e.b).with(&tool_);
            split(e.a, e.b, crossing(e.a, e.b, tools), tools);
        }
    }

    /// Collects the faces, and edges of shells, that part elements on one side of the tool from those on the other.
    void collect_faces(int tag) {
        constexpr int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
        const auto touches = [&](int v) { return d_.contact[v].has(&tool_); };
        std::map<std::array<int, 3>, int> sides;      // side of the first tetrahedron met
        std::map<std::array<int, 2>, int> edge_sides;
        for (int v = 0; v < band_.size(); ++v) {
            if (!touches(v)) continue;
            for (const int t : band_.tetras.around(v)) {
                const auto& n = band_.tetras[t];
                for (const auto& f : faces) {
                    std::array<int, 3> key{n[f[0]], n[f[1]], n[f[2]]};
                    if (!std::ranges::all_of(key, touches) || std::ranges::min(key) != v) continue;
                    std::ranges::sort(key);
                    const int side = side_of(n);
                    const auto [first, fresh] = sides.emplace(key, side);
                    if (!fresh && first->second * side < 0) band_.cut_faces.add(key, tag);
                }
            }
            for (const int t : band_.triangles.around(v)) {
                if (!d_.constraints.is_shell(band_.triangles.origin(t))) continue;
                for (const int w : band_.triangles[t]) {
                    if (w <= v || !touches(w)) continue;
                    const int side = side_of(band_.triangles[t]);
                    const auto [first, fresh] = edge_sides.emplace(std::array{v, w}, side);
                    if (!fresh && first->second * side < 0 && band_.cut_edges.find({v, w}) < 0) band_.cut_edges.add({v, w}, tag);
                }
            }
        }
    }

private:
    struct Edge {
        double length;
        int a, b;
    };

    /// The side an element lies on: of its node farthest from the tool, or of its middle when all are on it.
    int side_of(const auto& nodes) const {
        double furthest = 0;
        Vec3 middle = Vec3::Zero();
        for (const int v : nodes) {
            if (std::abs(value_[v]) > std::abs(furthest)) furthest = value_[v];
            middle += band_.nodes[v].at / static_cast<double>(nodes.size());
        }
        if (std::abs(furthest) <= f_.tolerance) furthest = tool_.distance(middle);
        return furthest > 0 ? 1 : -1;
    }

    /// The elements in which the blade is wanted.
    void find_region() {
        everywhere_ = !blade_.bound && blade_.inside.empty();
        if (everywhere_) return;
        std::vector<double> bound(static_cast<std::size_t>(band_.size()), -std::numeric_limits<double>::infinity());
        if (blade_.bound)
            for (int v = 0; v < band_.size(); ++v) bound[v] = blade_.bound(band_.nodes[v].at);
        std::vector<char> outside(static_cast<std::size_t>(band_.size()), 0);
        for (const Tool* t : blade_.inside)
            for (int v = 0; v < band_.size(); ++v) outside[v] = outside[v] || f_.value(v, *t) > f_.tolerance;
        const auto choose = [&](const auto& list, std::vector<char>& in) {
            in.assign(static_cast<std::size_t>(list.size()), 0);
            for (int s = 0; s < list.size(); ++s) {
                if (!list.alive(s)) continue;
                double least = std::numeric_limits<double>::infinity(), longest = 0;
                bool out = false;
                for (const int v : list[s]) {
                    out = out || outside[v];
                    least = std::min(least, bound[v]);
                    for (const int w : list[s]) longest = std::max(longest, (band_.nodes[v].at - band_.nodes[w].at).squaredNorm());
                }
                in[s] = !out && least <= blade_margin * std::sqrt(longest);
            }
        };
        choose(band_.tetras, tetra_in_);
        choose(band_.triangles, triangle_in_);
    }

    bool any_around(int v, auto holds) const {
        for (const int s : band_.tetras.around(v))
            if ((everywhere_ || tetra_in_[s]) && holds(band_.tetras[s])) return true;
        for (const int s : band_.triangles.around(v))
            if ((everywhere_ || triangle_in_[s]) && holds(band_.triangles[s])) return true;
        return false;
    }

    bool in_region(int v) const {
        return everywhere_ || any_around(v, [](const auto&) { return true; });
    }

    bool crosses(int v) const {
        const double side = value_[v];
        return any_around(v, [&](const auto& nodes) {
            return std::ranges::any_of(nodes, [&](int w) { return value_[w] * side < 0; });
        });
    }

    /// The edges of triangles and tetrahedra of the region that `wanted` takes, longest first.
    std::vector<Edge> region_edges(auto wanted) {
        std::vector<Edge> edges;
        for (int v = 0; v < band_.size(); ++v) {
            neighbours_.clear();
            any_around(v, [&](const auto& nodes) {
                for (const int w : nodes)
                    if (w > v && wanted(v, w)) neighbours_.push_back(w);
                return false;
            });
            std::ranges::sort(neighbours_);
            neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
            for (const int w : neighbours_) edges.push_back({(band_.nodes[v].at - band_.nodes[w].at).norm(), v, w});
        }
        std::ranges::sort(edges, [](const Edge& x, const Edge& y) {
            return x.length != y.length ? x.length > y.length : std::pair(x.a, x.b) < std::pair(y.a, y.b);
        });
        return edges;
    }

    void split(int a, int b, const Vec3& at, const Contact& tools) {
        d_.split_edge(a, b, at, tools);
        if (&value_ != &f_.distance) value_.push_back(tools.has(&tool_) ? 0 : tool_.distance(at));
        f_.distance.push_back(tools.has(f_.tool) ? 0 : f_.tool->distance(at));
    }

    void snap(int v, double length, double ratio) {
        BandNode& node = band_.nodes[v];
        Vec3 target = node.at;
        const Contact tools = d_.contact[v].with(&tool_);
        if (!d_.constraints.project(v, tools, target)) {
            if (ratio > forced_reach || d_.contact[v]) return;
            target = tool_.project(node.at);
        }
        if ((target - node.at).norm() > snap_slide * length) return;
        if ((target - node.start).norm() > d_.constraints.leash(v)) return;
        const double before = quality_around(d_, v, node.at);
        const double after = quality_around(d_, v, target);
        if (!(after >= std::min(0.1, before / 4)) || !(after > 0)) return;
        node.at = target;
        d_.contact[v] = tools;
        value_[v] = 0;
    }

    /// The point of the edge a-b on the tool, moved along the tool onto the surface or curve the edge is on.
    Vec3 crossing(int a, int b, const Contact& tools) const {
        const Vec3 &pa = band_.nodes[a].at, &pb = band_.nodes[b].at;
        double ta = 0, tb = 1, da = value_[a], db = value_[b];
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
        return d_.fitted_split(a, b, at, tools);
    }

    Interface& f_;
    Deformable& d_;
    BandMesh& band_;
    const Blade& blade_;
    const Tool& tool_;
    std::vector<double>& value_;
    bool everywhere_ = true;
    std::vector<char> tetra_in_, triangle_in_;  // by slot
    std::vector<int> neighbours_;
};

/// Nodes born on a curved skin or tool where the curve would have spoiled an element lie on the chord at first. Now
/// that the band is relaxed, brings them onto their surface or curve; true if any moved.
bool fit_to_shapes(const Interface& f, Deformable& d) {
    bool any = false;
    for (int v = d.band.original_nodes(); v < d.band.size(); ++v) {
        if (!d.band.in_use(v) || (d.constraints[v].freedom == NodeFreedom::free && !d.contact[v])) continue;
        Vec3 x = d.band.nodes[v].at;
        if (d.constraints.distance(d.constraints[v], x) <= 1e-6 * d.band.mean_edge_length(v) && f.off_tools(v) <= f.tolerance) continue;
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

void cut_along(Interface& f, const Blade& blade) {
    Stopwatch watch(f.seconds);
    std::vector<double> own;
    if (blade.tool != f.tool) {
        own.resize(static_cast<std::size_t>(f.d.band.size()));
        for (int v = 0; v < f.d.band.size(); ++v) own[v] = f.value(v, *blade.tool);
    }
    Snapper snapper(f, blade, blade.tool == f.tool ? f.distance : own);
    snapper.touch_nodes();
    snapper.split_dipping_edges();
    snapper.snap_nodes();
    watch.lap("snap");
    snapper.split_edges();
    if (blade.tag >= 0) snapper.collect_faces(blade.tag);
    watch.lap("split");
}

void relax_band(Interface& f) {
    Stopwatch watch(f.seconds);
    find_node_sets(f);
    deform(f.d, f.nodes, f.transition);
    watch.lap("deform");
    improve(f, *f.tool, improvement_goal);
    for (int round = 0; round < 3 && fit_to_shapes(f, f.d); ++round) {
        find_node_sets(f);
        std::vector<int> movable = f.nodes;
        movable.insert(movable.end(), f.transition.begin(), f.transition.end());
        relax(f.d, movable);
    }
    warn_of_misfits(f);
    watch.lap("improve");
}

void snap_to_tool(Interface& f, const Blade& blade) {
    cut_along(f, blade);
    f.d.barrier = blade.tool;
    for (int v = 0; v < f.d.band.size(); ++v)
        f.d.side[v] = static_cast<signed char>((f.distance[v] > 0) - (f.distance[v] < 0));
    relax_band(f);
}

}  // namespace femscalpel
