// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "cancel.h"
#include "cutting/folded_input.h"
#include "cutting/improve.h"
#include "cutting/mend_curved.h"
#include "cutting/root.h"
#include "cutting/workpiece.h"
#include "deformation/curved_shape.h"
#include "deformation/deformation.h"
#include "deformation/relaxation.h"
#include "mesh/quality.h"
#include "mesh/stopwatch.h"

namespace femscalpel {
namespace {

/// A node farther than this from the tool, in local edge lengths, is not moved onto it.
constexpr double snap_reach = 0.45;
/// Sliding along a slanting surface may take it farther, up to this.
constexpr double snap_slide = 1.0;
/// Elements worse than this after relaxation are worked on further.
constexpr double improvement_goal = 0.45;
/// The part for is_beside() where elements came out poor enough to try again.
constexpr double poor_beside = 2e-3;
/// Sine of the angle between the tool and a surface (line) up to which it runs along that.
constexpr double along = 2e-3;
/// Going onto the tool, a node may slide so many times its distance along what holds it before it is rather put there
/// straight.
constexpr double steep = 4;
/// An edge that dips this deep through a curved tool, in its own length, gets a node in between.
constexpr double dip = 0.15;

/// A new node may be this many edge lengths off the curved surface or curve it was born on.
constexpr double largest_misfit = 5e-4;
/// Elements below this mean ratio are refined before another try.
constexpr double poor_quality = 0.1;
/// The same in second-order meshes, where mending curved elements costs their corners' shape.
constexpr double second_order_quality = 0.27;
/// Elements below this would be an error, or need one's attention: poor.h. Their nodes are rather held beside the tool.
constexpr double hold_quality = 0.02;
/// After so many tries with sound elements the best is taken; while that is below poor_quality, after so many.
constexpr int polishings = 5, hard_polishings = 8;
/// A band is refined to so many times its elements at most, and by so many times the mesh's: it would grow for ever
/// along a wall too thin for elements, and what is cut in the end should not be another mesh.
constexpr double largest_growth = 4, largest_part = 1;
/// The same of dividing elements for better ones after the cut.
constexpr double largest_part_after = 2.75;
/// All tries together may move nodes so often, and so many times more for each element of the band: some seconds, where
/// second-order elements make it slow.
constexpr double fewest_visits = 1.5e5, visits_per_element = 4;
/// A curved mesh with elements below this is not returned.
constexpr double degenerate_quality = 0.01;

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
            const Contact tools = d_.edge_contact(e.a, e.b).with(&tool_);
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

    void hold_if_beside(int v, double part) {
        const double reach = reach_beyond(v);
        if (!is_beside(value_[v], reach, part)) {
            if (is_beside(value_[v], reach, along_beside))
                f_.passed[v] =
                    d_.constraints[v].freedom == NodeFreedom::curve && runs_along(v) ? 0 : std::abs(value_[v]) / reach;
            return;
        }
        d_.hold_beside(v, d_.contact[v].with(&tool_));
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
        d_.split_edge(a, b, at, tools);
        if (&value_ != &f_.distance) value_.push_back(tools.has(&tool_) ? 0 : tool_.distance(at));
        f_.distance.push_back(tools.has(f_.tool) ? 0 : f_.tool->distance(at));
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

/// Elements of the input, by slot, and where in them something went wrong.
struct Slots {
    std::vector<int> tetras, triangles;
    std::vector<Vec3> places;

    bool empty() const { return tetras.empty() && triangles.empty(); }
    void tidy() {
        for (std::vector<int>* list : {&tetras, &triangles}) {
            std::ranges::sort(*list);
            list->erase(std::unique(list->begin(), list->end()), list->end());
        }
    }
};

Vec3 middle_of(const BandMesh& band, const auto& nodes) {
    Vec3 sum = Vec3::Zero();
    for (const int v : nodes) sum += band.nodes[v].at;
    return sum / static_cast<double>(nodes.size());
}

/// Those in which new nodes are off their tools or the curved skin they were born on, or parts came out as folded
/// second-order elements.
Slots misfits(const Workpiece& f) {
    const BandMesh& band = f.d.band;
    Slots found;
    for (const BandElement e : newly_folded(f, folded_elements(f, least_curved))) {
        (e.triangle ? found.triangles : found.tetras).push_back(e.origin(band));
        found.places.push_back(middle_of(band, e.nodes(band)));
    }
    for (int v = band.original_nodes(); v < band.size(); ++v) {
        if (!band.in_use(v)) continue;
        const NodeConstraint& c = f.d.constraints[v];
        const double allowed = f.d.constraints.is_straight(c) ? std::max(10 * f.tolerance, f.d.rounding)
                                                              : largest_misfit * band.mean_edge_length(v);
        const bool on_shape = f.d.constraints.distance(c, band.nodes[v].at) <= allowed;
        if (on_shape && f.d.off_tools(v) <= 10 * f.tolerance) continue;
        found.places.push_back(band.nodes[v].at);
        for (const int t : band.tetras.around(v)) found.tetras.push_back(band.tetras.origin(t));
        for (const int t : band.triangles.around(v)) found.triangles.push_back(band.triangles.origin(t));
    }
    found.tidy();
    return found;
}

/// The smallest mean ratio of the tetrahedra and shells that were changed, and those that have parts below `limit`.
double poorest(const Workpiece& f, double limit, Slots& poor) {
    const BandMesh& band = f.d.band;
    double worst = 1;
    SparseCheck check;
    const auto look = [&](const auto& list, std::vector<int>& origins, auto quality_of) {
        for (int s = 0; s < list.size(); ++s) {
            if (!list.alive(s) || std::ranges::none_of(list[s], [&](int v) {
                    return band.is_new(v) || band.nodes[v].at != band.nodes[v].start;
                }))
                continue;
            check();
            const double quality = quality_of(s);
            worst = std::min(worst, quality);
            if (quality >= limit) continue;
            origins.push_back(list.origin(s));
            poor.places.push_back(middle_of(band, list[s]));
        }
    };
    look(band.tetras, poor.tetras, [&](int t) { return tetra_quality(f.d, t); });
    look(band.triangles, poor.triangles,
         [&](int t) { return f.d.constraints.is_shell(band.triangles.origin(t)) ? shell_quality(f.d, t) : 1.0; });
    poor.tidy();
    return worst;
}

/// Calls visit(nodes) for the parts of some elements.
void for_parts(const BandMesh& band, const Slots& slots, auto visit) {
    const auto look = [&](const auto& list, const std::vector<int>& origins) {
        if (origins.empty()) return;
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s) && std::ranges::binary_search(origins, list.origin(s))) visit(list[s]);
    };
    look(band.tetras, slots.tetras);
    look(band.triangles, slots.triangles);
}

int element_count(const BandMesh& band) { return band.tetras.size() + band.triangles.size(); }

/// Bisects the edges of some elements, longest first; of those already divided, the parts at the places only. Halves
/// bulge a quarter as far, so that a tool finds room between a curved skin and its chords where it found none. The band
/// grows to about `most_elements`.
void refine(Workpiece& f, const Slots& slots, double most_elements) {
    BandMesh& band = f.d.band;
    std::vector<std::tuple<double, int, int>> edges;
    for_parts(band, slots, [&](const auto& nodes) {
        const Vec3 middle = middle_of(band, nodes);
        double longest = 0;
        for (const int a : nodes)
            for (const int b : nodes) longest = std::max(longest, (band.nodes[a].at - band.nodes[b].at).squaredNorm());
        const bool divided = std::ranges::any_of(nodes, [&](int v) { return band.is_new(v); });
        if (divided &&
            std::ranges::none_of(slots.places, [&](const Vec3& x) { return (x - middle).squaredNorm() <= longest; }))
            return;
        for (const int a : nodes)
            for (const int b : nodes)
                if (a < b && (band.nodes[a].movable() || band.nodes[b].movable()))
                    edges.push_back({-(band.nodes[a].at - band.nodes[b].at).norm(), a, b});
    });
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [length, a, b] : edges) {
        if (element_count(band) >= most_elements) break;
        // With both ends on the tool the halves would have to be, too.
        if (f.d.contact[a].common(f.d.contact[b]) || f.d.constraints.has_fixed_middle(a, b)) continue;
        const Deformable::SplitPoint point = f.d.fitted_split(a, b, f.d.along_edge(a, b, 0.5), {});
        if (!point.fits || !(point.worst > 0.1)) continue;
        f.d.split_edge(a, b, point.at, {});
        f.distance.push_back(f.tool->distance(point.at));
    }
}

/// Lets the nodes of poor elements be held where the tool passed them by up to `part`; false if there are none.
bool allow_to_hold(Workpiece& start, const Workpiece& cut, double part) {
    Slots poor;
    poorest(cut, poor_quality, poor);
    start.may_hold.assign(static_cast<std::size_t>(start.d.band.size()), 0);
    bool any = false;
    for_parts(start.d.band, poor, [&](const auto& nodes) {
        for (const int v : nodes) {
            start.may_hold[v] = part;
            const auto passed = cut.passed.find(v);
            any = any || (passed != cut.passed.end() && passed->second <= part);
        }
    });
    if (!any) start.may_hold.clear();
    return any;
}

[[noreturn]] void fail_at(const Workpiece& f, const Slots& slots) {
    std::optional<Vec3> place;
    bool skin = false;
    for_parts(f.d.band, slots, [&](const auto& nodes) {
        if (!place) place = f.d.band.nodes[nodes[0]].start;
        skin = skin || std::ranges::any_of(nodes, [&](int v) { return f.d.constraints.is_exterior(v); });
    });
    std::ostringstream text;
    text << "no sound elements were found where the " << f.tool->kind()
         << (skin ? " meets the skin" : " passes inside the material");
    if (place) text << " near (" << place->transpose() << ")";
    text << ": the mesh is too coarse there, or only a thin layer of material is left"
         << (skin ? "" : " between it and a border") << ". Move the " << f.tool->kind()
         << " a little, or refine the mesh";
    throw QualityError(text.str());
}

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

void relax_band(Workpiece& f) {
    Stopwatch watch(f.seconds);
    find_node_sets(f);
    deform(f.d, f.nodes, f.transition);
    if (!f.released.empty()) relax(f.d, movable_nodes(f));
    watch.lap("deform");
    improve(f, *f.tool, improvement_goal);
    for (int round = 0; round < 3; ++round) {
        const std::vector<int> moved = fit_to_shapes(f);
        if (moved.empty()) break;
        relax_near(f, moved);
    }
    mend_curved(f, *f.tool);
    watch.lap("improve");
}

void cut_soundly(Workpiece& f, const std::function<void(Workpiece&)>& cut, Index mesh_elements, int attempts,
                 bool whole_tool) {
    const bool plain =
        whole_tool && !f.d.mids.any() && !f.d.constraints.any_curved() && !std::isfinite(f.tool->feature_size());
    Workpiece start = f;
    const double elements = element_count(start.d.band),
                 most_elements =
                     std::min(largest_growth * elements, elements + largest_part * static_cast<double>(mesh_elements));
    std::optional<Workpiece> best;
    double best_quality = plain ? -std::numeric_limits<double>::infinity() : degenerate_quality;
    bool tried_to_hold = false;
    start.most_elements = f.most_elements = elements + largest_part_after * static_cast<double>(mesh_elements);
    // Deformable::visits counts on from one try to the next.
    start.most_visits = f.most_visits = f.d.visits + static_cast<long>(fewest_visits + visits_per_element * elements);
    for (int attempt = 1, polished = 0;; ++attempt) {
        check_cancelled();
        cut(f);
        start.d.visits = f.d.visits;
        Slots bad = misfits(f);
        // What could not be mended before does not get better by trying again; once, a plane may pass beside it.
        if (attempt > 1) check_folded_input(f, newly_folded(f, folded_elements(f, least_curved)));
        bool polish = false;
        if (bad.empty()) {
            const double enough = f.d.mids.any() ? second_order_quality : poor_quality;
            const double quality = poorest(f, std::max(1.5 * poor_quality, enough), bad);
            if (quality >= enough) return;
            polish = true;
            const bool too_many =
                element_count(f.d.band) - elements > (largest_growth - 1) * static_cast<double>(mesh_elements);
            if (quality > best_quality && !(too_many && best && best_quality >= hold_quality)) {
                best_quality = quality;
                best = f;
            } else {
                start.may_hold.clear();
            }
            // Among flat surfaces a plane's geometry limits the quality, but for nodes that it passes too closely.
            if (plain && (tried_to_hold || quality >= poor_quality)) break;
            if (++polished >= (best_quality < poor_quality ? hard_polishings : polishings) && best) break;
        }
        if (attempt == attempts || element_count(start.d.band) >= most_elements || f.d.visits >= f.most_visits) {
            if (!best) fail_at(f, bad);
            break;
        }
        // First the nodes of these elements are not put on the tool, then the elements are refined; a curved tool would
        // get farther into elements whose nodes are not put on it.
        std::vector<char>& off_tool = start.d.off_tool;
        const bool may_hold = polish && !tried_to_hold && best_quality < poor_quality;
        if (may_hold && allow_to_hold(start, f, best_quality < hold_quality ? along_beside : poor_beside)) {
            tried_to_hold = true;
        } else if (plain && polish) {
            break;
        } else if (attempt % 2 == 1 && !polish && !std::isfinite(f.tool->feature_size())) {
            for_parts(start.d.band, bad, [&](const auto& nodes) {
                for (const int v : nodes) off_tool[v] = 1;
            });
        } else {
            refine(start, bad, most_elements);
            std::ranges::fill(off_tool, 0);
        }
        f = start;
    }
    f = std::move(*best);
    if (best_quality >= poor_quality || plain) return;
    std::ostringstream text;
    text.precision(2);
    text << "the " << f.tool->kind()
         << " meets surfaces and borders so that elements there come out with a mean ratio of " << best_quality
         << " at best: refine the mesh there for better ones";
    f.warnings.push_back(text.str());
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
