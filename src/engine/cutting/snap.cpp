// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/snap.h"

#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "cancel.h"
#include "cutting/improve.h"
#include "cutting/retry.h"
#include "cutting/root.h"
#include "cutting/workpiece.h"
#include "deformation/curved_shape.h"
#include "error.h"
#include "mesh/quality.h"
#include "mesh/stopwatch.h"

namespace femscalpel {
namespace {

/// A node farther than this from the tool, in local edge lengths, is not moved onto it.
constexpr double snap_reach = 0.45;
/// Sliding along a slanting surface may take it farther, up to this.
constexpr double snap_slide = 1.0;
/// Sine of the angle between the tool and a surface (line) up to which it runs along that.
constexpr double along = 2e-3;
/// Going onto the tool, a node may slide so many times its distance along what holds it before it is rather put there
/// straight.
constexpr double steep = 4;
/// An edge that dips this deep through a curved tool, in its own length, gets a node in between.
constexpr double dip = 0.15;

[[noreturn]] void refuse_fourth(const Vec3& at) {
    std::ostringstream message;
    message << "four surfaces come together near (" << at.x() << " " << at.y() << " " << at.z()
            << "), which no node can lie on all of: make them one after the other, or smaller";
    throw QualityError(message.str());
}

class Snapper {
public:
    /// `value`: signed distances to the blade's tool by band node, exactly 0 in contact.
    Snapper(Workpiece& workpiece, const Blade& blade, std::vector<double>& value)
        : f_(workpiece), d_(workpiece.d), band_(workpiece.d.band), blade_(blade), tool_(*blade.tool), value_(value) {
        find_region();
    }

    /// Nodes that already lie on the tool, where it is wanted.
    void touch_nodes() {
        for (int v = 0; v < band_.size(); ++v) {
            if (std::abs(value_[v]) > std::max(f_.tolerance, d_.rounding) || d_.contact[v].has(&tool_) ||
                d_.contact[v].full() || !in_region(v))
                continue;
            put_on_tool(f_, v, tool_);
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
            split(e.a, e.b, d_.fitted_split(e.a, e.b, d_.along_edge(e.a, e.b, 0.5), tools).at, tools);
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
        for (const Candidate& c : candidates) {
            check_cancelled();
            if (crosses(c.node) && !snap(c.node, c.length)) hold_if_beside(c.node, part_to_hold(c.node));
        }
        // The ends of a row that is held.
        for (const Candidate& c : candidates)
            if (value_[c.node] != 0 && any_around(c.node, [&](const auto& nodes) {
                    return std::ranges::any_of(nodes, [&](int v) { return d_.held_off[v] > 0; });
                }))
                hold_if_beside(c.node,
                               d_.constraints[c.node].freedom == NodeFreedom::fixed ? along_beside : close_beside);
    }

    void split_edges() {
        for (const Edge& e : region_edges([&](int a, int b) { return value_[a] * value_[b] < 0; })) {
            const Contact tools = and_tool(d_.edge_contact(e.a, e.b), e.a);
            split(e.a, e.b, crossing(e.a, e.b, tools), tools);
        }
    }

    /// Collects the faces, and edges of shells, that part elements on one side of the tool from those on the other.
    void collect_faces(int tag) {
        const auto touches = [&](int v) { return d_.contact[v].has(&tool_); };
        std::map<std::array<int, 3>, int> sides;  // side of the first tetrahedron met
        struct Shells {
            bool positive = false, negative = false, flat = false;
            bool parted() const { return positive + negative + flat > 1; }
        };
        std::map<std::array<int, 2>, Shells> shells_at;
        SparseCheck check(64);
        for (int v = 0; v < band_.size(); ++v) {
            if (!touches(v)) continue;
            check();
            for (const int t : band_.tetras.around(v)) {
                const auto& n = band_.tetras[t];
                for (const auto& f : outward_faces) {
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
                    Shells& at = shells_at[{v, w}];
                    if (lies_flat(band_.triangles[t]))
                        at.flat = true;
                    else
                        (side_of(band_.triangles[t]) > 0 ? at.positive : at.negative) = true;
                    if (at.parted() && band_.cut_edges.find({v, w}) < 0) band_.cut_edges.add({v, w}, tag);
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

    /// Whether a shell lies in a tool: what stands on it can be parted from it.
    bool lies_flat(const std::array<int, 3>& nodes) const {
        Vec3 middle = Vec3::Zero();
        for (const int v : nodes) {
            if (std::abs(value_[v]) > f_.tolerance) return false;
            middle += band_.nodes[v].at / 3;
        }
        return std::abs(tool_.distance(middle)) <= f_.tolerance;
    }

    /// The elements in which the blade is wanted.
    void find_region() {
        check_cancelled();
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
                    for (const int w : list[s])
                        longest = std::max(longest, (band_.nodes[v].at - band_.nodes[w].at).squaredNorm());
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

    /// The part for is_beside(), of a node that could not be moved onto the tool.
    double part_to_hold(int v) const {
        const double part = f_.part_to_hold(v);
        const NodeFreedom freedom = d_.constraints[v].freedom;
        // Beyond a line there may be room for small elements of good shape.
        if (freedom != NodeFreedom::surface && (freedom != NodeFreedom::curve || part == close_beside)) return part;
        return runs_along(v) ? along_beside : part;
    }

    /// Whether the tool runs along what holds a node.
    bool runs_along(int v) const {
        Eigen::Matrix3d tangents;
        const int count = d_.constraints.tangents(v, {}, band_.nodes[v].at, tangents);
        return (tangents.leftCols(count).transpose() * tool_.normal(band_.nodes[v].at)).norm() < along;
    }

    /// `on` and the tool; at most three fix a node.
    Contact and_tool(const Contact& on, int v) const {
        if (on.full() && !on.has(&tool_)) refuse_fourth(band_.nodes[v].at);
        return on.with(&tool_);
    }

    void hold_if_beside(int v, double part) {
        const double reach = reach_beyond(v);
        if (!is_beside(value_[v], reach, part)) {
            if (is_beside(value_[v], reach, far_beside))
                f_.passed[v] =
                    d_.constraints[v].freedom == NodeFreedom::curve && runs_along(v) ? 0 : std::abs(value_[v]) / reach;
            return;
        }
        d_.hold_beside(v, and_tool(d_.contact[v], v));
        value_[v] = 0;
    }

    /// How far the elements around a node reach to the other side of the tool.
    double reach_beyond(int v) const {
        double farthest = 0;
        any_around(v, [&](const auto& nodes) {
            for (const int w : nodes)
                if (value_[w] * value_[v] < 0) farthest = std::max(farthest, std::abs(value_[w]));
            return false;
        });
        return farthest;
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
        f_.split_edge(a, b, at, tools);
        if (&value_ != &f_.distance) value_.push_back(tools.has(&tool_) ? 0 : tool_.distance(at));
    }

    /// Whether, with v on the tool, a face of a curved skin (a segment of a curved line) would lie on it with all its
    /// nodes: the tool nearly touches the skin there, and curved elements have no room between the two.
    bool would_lie_flat(int v) const {
        if (!d_.mids.any()) return false;
        const auto rest_lies = [&](const auto& nodes) {
            return std::ranges::all_of(nodes, [&](int w) { return w == v || d_.contact[w]; });
        };
        return std::ranges::any_of(
                   band_.skin.around(v),
                   [&](int s) { return !d_.constraints.is_flat(band_.skin.tag(s)) && rest_lies(band_.skin[s]); }) ||
               std::ranges::any_of(band_.creases.around(v), [&](int s) {
                   return !d_.constraints.is_straight(
                              d_.constraints.on_edge(band_, band_.creases[s][0], band_.creases[s][1])) &&
                          rest_lies(band_.creases[s]);
               });
    }

    /// Whether, with v on a curved tool, an element would have all its nodes on it: one that fills a bulge of the tool,
    /// belongs to neither side, and gets a better shape only by growing along the tool.
    bool would_fill_bulge(int v) const {
        if (!std::isfinite(tool_.feature_size())) return false;
        const auto fills = [&](const auto& nodes) {
            return std::ranges::all_of(nodes, [&](int w) { return w == v || d_.contact[w].has(&tool_); });
        };
        return std::ranges::any_of(band_.tetras.around(v), [&](int t) { return fills(band_.tetras[t]); }) ||
               std::ranges::any_of(band_.triangles.around(v), [&](int t) {
                   return d_.constraints.is_shell(band_.triangles.origin(t)) && fills(band_.triangles[t]);
               });
    }

    /// Moves a node onto the tool; false where that cannot be, or would spoil elements.
    bool snap(int v, double length) {
        if (d_.off_tool[v] || would_lie_flat(v) || would_fill_bulge(v)) return false;
        BandNode& node = band_.nodes[v];
        Vec3 target = node.at;
        const Contact tools = d_.contact[v].with(&tool_);
        if (!d_.constraints.project(v, tools, target)) return false;
        if ((target - node.at).norm() > snap_slide * length) return false;
        if ((target - node.start).norm() > d_.constraints.leash(v)) return false;
        const double before = quality_around(d_, v, node.at);
        const double after = quality_around(d_, v, target);
        if (!(after >= std::min(0.1, before / 4)) || !(after > 0) || !keeps_curved_shape(d_, v, target)) return false;
        node.at = target;
        d_.contact[v] = tools;
        value_[v] = 0;
        return true;
    }

    /// The point of the edge a-b on the tool, and on the surface or curve the edge is on.
    Vec3 crossing(int a, int b, const Contact& tools) const {
        const Vec3 &pa = band_.nodes[a].at, &pb = band_.nodes[b].at;
        Vec3 at = pa;
        root_between(value_[a], value_[b], 1e-3 * f_.tolerance, [&](double t) {
            at = d_.along_edge(a, b, t);
            return tool_.distance(at);
        });
        const Deformable::SplitPoint bent = d_.fitted_split(a, b, at, tools);
        if (bent.fits && bent.worst > 0) return bent.at;
        // On the chord elements stay sound; the surface has to wait.
        const double t = value_[a] / (value_[a] - value_[b]);
        Vec3 straight = pa + t * (pb - pa);
        return d_.constraints.project(NodeConstraint{}, tools, straight) ? straight : bent.at;
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    const Blade& blade_;
    const Tool& tool_;
    std::vector<double>& value_;
    bool everywhere_ = true;
    std::vector<char> tetra_in_, triangle_in_;  // by slot
    std::vector<int> neighbours_;
};

}  // namespace

void put_on_tool(Workpiece& f, int v, const Tool& tool) {
    Deformable& d = f.d;
    const Contact tools = d.contact[v].with(&tool);
    BandNode& node = d.band.nodes[v];
    const double off = Deformable::off_tools(tools, node.at, 0);
    d.contact[v] = tools;
    if (off <= f.tolerance) return;
    Vec3 target = node.at;
    if (node.movable() && (!d.constraints.project(v, tools, target) || (target - node.at).norm() > steep * off)) {
        target = tool.project(node.at);
        d.constraints.fix_node(v);
    }
    if (quality_around(d, v, target) > 0.5 * quality_around(d, v, node.at)) node.at = target;
    if (Deformable::off_tools(tools, node.at, 0) > f.tolerance) d.hold_beside(v, tools);
}

void cut_along(Workpiece& f, const Blade& blade) {
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

void snap_to_tool(Workpiece& f, const Blade& blade, Index mesh_elements) {
    cut_soundly(
        f,
        [&blade](Workpiece& g) {
            cut_along(g, blade);
            g.d.barrier = blade.tool;
            for (int v = 0; v < g.d.band.size(); ++v)
                g.d.side[v] = static_cast<signed char>((g.distance[v] > 0) - (g.distance[v] < 0));
            relax_band(g);
        },
        mesh_elements, 12, true);
}

}  // namespace femscalpel
