// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/border.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "cancel.h"
#include "cutting/no_cut.h"
#include "cutting/root.h"
#include "cutting/snap.h"
#include "error.h"
#include "mesh/stopwatch.h"

namespace femscalpel {
namespace {

/// As in snap.cpp.
constexpr double snap_reach = 0.45;
constexpr double snap_slide = 1.0;
/// An edge that dips this deep over the border, in its own length, gets a node in between.
constexpr double dip = 0.1;
/// A front edge may be off the border's curve by this part of the patch's smallest radius.
constexpr double deepest_sag = 0.2;

class BorderCutter {
public:
    BorderCutter(Workpiece& f, const Patch& patch) : f_(f), d_(f.d), band_(f.d.band), patch_(patch) {}

    void run() {
        for (const Patch::Corner& c : patch_.corners) place_corner(c);
        value_.resize(static_cast<std::size_t>(band_.size()));
        for (int v = 0; v < band_.size(); ++v) measure(v);
        split_dipping_edges(false);
        snap_nodes();
        // A node put on one side of a corner may have closed it, or left an edge across it; the other side has to be
        // found again.
        if (!patch_.corners.empty()) split_dipping_edges(true);
        for (const auto& [a, b] : edges([&](int a, int b) { return value_[a] * value_[b] < 0; })) {
            const Vec3 at = crossing(a, b);
            split(a, b, at, Contact(f_.tool).with(&side_at(at)));
        }
    }

private:
    bool on_interface(int v) const { return !band_.cut_faces.around(v).empty() || !band_.cut_edges.around(v).empty(); }
    const Tool& side_at(const Vec3& x) const { return *patch_.sides[patch_.side(x)]; }

    /// Signed distance to the border; a node that lies on it, but for rounding, is put in contact.
    void measure(int v) {
        if (!on_interface(v)) return;
        for (const Tool* t : d_.contact[v].tools())
            if (patch_.has(t)) {
                value_[v] = 0;
                return;
            }
        value_[v] = patch_.distance(band_.nodes[v].at);
        if (std::abs(value_[v]) > std::max(f_.tolerance, d_.rounding) || d_.contact[v].full()) return;
        put_on_tool(f_, v, side_at(band_.nodes[v].at));
        value_[v] = 0;
    }

    /// Nodes joined to v by an edge of the interface.
    std::set<int> interface_neighbours(int v) const {
        std::set<int> out;
        for (const int s : band_.cut_faces.around(v)) out.insert(band_.cut_faces[s].begin(), band_.cut_faces[s].end());
        for (const int s : band_.cut_edges.around(v)) out.insert(band_.cut_edges[s].begin(), band_.cut_edges[s].end());
        out.erase(v);
        return out;
    }

    double length(int a, int b) const { return (band_.nodes[a].at - band_.nodes[b].at).norm(); }

    /// The interface's edges that `wanted` takes, longest first.
    std::vector<std::pair<int, int>> edges(auto wanted) const {
        std::vector<std::pair<double, std::pair<int, int>>> found;
        SparseCheck check(8);
        for (int v = 0; v < band_.size(); ++v, check())
            if (on_interface(v))
                for (const int w : interface_neighbours(v))
                    if (w > v && wanted(v, w)) found.push_back({-length(v, w), {v, w}});
        std::ranges::sort(found);
        std::vector<std::pair<int, int>> out;
        out.reserve(found.size());
        for (const auto& [negative_length, e] : found) out.push_back(e);
        return out;
    }

    int split(int a, int b, const Vec3& at, const Contact& tools) {
        const int node = f_.split_edge(a, b, d_.fitted_split(a, b, at, tools).at, tools);
        value_.resize(static_cast<std::size_t>(band_.size()));
        measure(node);
        return node;
    }

    /// Whether a-b is opposite a corner of the patch in a face of the interface.
    bool faces_corner(int a, int b) const {
        return std::ranges::any_of(band_.cut_faces.around(a), [&](int s) {
            const auto& n = band_.cut_faces[s];
            return std::ranges::find(n, b) != n.end() &&
                   std::ranges::any_of(n, [&](int v) { return v != a && v != b && d_.contact[v].full(); });
        });
    }

    /// Where along a-b (0 to 1) it is deepest beyond the border though both ends are on one side; negative where it
    /// stays there. Shallow dips count only if `exact`, or opposite a corner: there the border has to come out, however
    /// narrow the corner is.
    double dip_at(int a, int b, bool exact) const {
        const double ends = value_[a] != 0 ? value_[a] : value_[b];
        if (ends == 0 || value_[a] * value_[b] < 0 || std::min(std::abs(value_[a]), std::abs(value_[b])) > length(a, b))
            return -1;
        const auto depth = [&](double t) {
            return patch_.distance((1 - t) * band_.nodes[a].at + t * band_.nodes[b].at) * (ends > 0 ? -1 : 1);
        };
        exact = exact || faces_corner(a, b);
        const int samples = exact ? 64 : 8;
        double best = -std::numeric_limits<double>::infinity(), at = -1;
        for (int k = 1; k < samples; ++k) {
            const double t = k / static_cast<double>(samples), d = depth(t);
            if (d <= best) continue;
            best = d;
            at = t;
        }
        if (exact)  // the dip may be narrower than the samples are apart
            for (double step = 0.5 / samples; step > 1e-6; step /= 2)
                for (const double t : {at - step, at + step})
                    if (const double d = depth(t); d > best) {
                        best = d;
                        at = t;
                    }
        return best > (exact ? std::max(1e-6 * length(a, b), 10 * f_.tolerance) : dip * length(a, b)) ? at : -1;
    }

    void split_dipping_edges(bool exact) {
        for (int round = 0; round < 3; ++round) {
            const auto dipping = edges([&](int a, int b) { return dip_at(a, b, exact) > 0; });
            for (const auto& [a, b] : dipping) {
                const double t = dip_at(a, b, exact);
                split(a, b, (1 - t) * band_.nodes[a].at + t * band_.nodes[b].at, f_.tool);
            }
            if (dipping.empty()) break;
        }
    }

    bool crosses(int v) const {
        return std::ranges::any_of(interface_neighbours(v), [&](int w) { return value_[v] * value_[w] < 0; });
    }

    /// How far the interface around a node reaches beyond the border.
    double reach_beyond(int v) const {
        double farthest = 0;
        for (const int w : interface_neighbours(v))
            if (value_[v] * value_[w] < 0) farthest = std::max(farthest, std::abs(value_[w]));
        return farthest;
    }

    void snap_nodes() {
        struct Candidate {
            double ratio;
            int node;
            double length;
        };
        std::vector<Candidate> candidates;
        for (int v = 0; v < band_.size(); ++v) {
            if (!on_interface(v) || value_[v] == 0 || d_.contact[v].full() || !crosses(v)) continue;
            const double mean = band_.mean_edge_length(v), ratio = std::abs(value_[v]) / mean;
            if (ratio < snap_reach) candidates.push_back({ratio, v, mean});
        }
        std::ranges::sort(candidates, [](const Candidate& x, const Candidate& y) {
            return std::pair(x.ratio, x.node) < std::pair(y.ratio, y.node);
        });
        for (const Candidate& c : candidates) {
            check_cancelled();
            if (!crosses(c.node)) continue;
            const Contact tools = d_.contact[c.node].with(&side_at(band_.nodes[c.node].at));
            if (snap(c.node, c.length, tools)) continue;
            const double reach = reach_beyond(c.node);
            if (!is_beside(value_[c.node], reach, f_.part_to_hold(c.node))) {
                if (is_beside(value_[c.node], reach, far_beside)) f_.passed[c.node] = std::abs(value_[c.node]) / reach;
                continue;
            }
            d_.hold_beside(c.node, tools);
            value_[c.node] = 0;
        }
    }

    bool snap(int v, double length, const Contact& tools) {
        Vec3 target = band_.nodes[v].at;
        if (!d_.constraints.project(v, tools, target)) return false;
        // Beyond the end of a polygon's side there is no border.
        if (std::abs(patch_.distance(target)) > f_.tolerance) return false;
        return move(v, target, tools, snap_slide * length, 0.1);
    }

    bool move(int v, const Vec3& target, const Contact& tools, double reach, double enough) {
        BandNode& node = band_.nodes[v];
        if ((target - node.at).norm() > reach || (target - node.start).norm() > d_.constraints.leash(v)) return false;
        const double before = quality_around(d_, v, node.at), after = quality_around(d_, v, target);
        if (!(after >= std::min(enough, before / 4)) || !(after > 0)) return false;
        node.at = target;
        d_.contact[v] = tools;
        if (static_cast<std::size_t>(v) < value_.size()) value_[v] = 0;
        return true;
    }

    /// The point of the edge a-b on the border.
    Vec3 crossing(int a, int b) const {
        const Vec3 &pa = band_.nodes[a].at, &pb = band_.nodes[b].at;
        const auto at = [&](double t) { return Vec3(pa + t * (pb - pa)); };
        return at(
            root_between(value_[a], value_[b], 1e-3 * f_.tolerance, [&](double t) { return patch_.distance(at(t)); }));
    }

    /// The face of the interface a corner of the patch lies in, where it is least outside, and how far, in heights of
    /// the face; -1 for none.
    std::pair<int, double> face_at(const Vec3& corner) const {
        int face = -1;
        double least = 0.1;
        for (int s = 0; s < band_.cut_faces.size(); ++s) {
            if (!band_.cut_faces.alive(s)) continue;
            const auto& n = band_.cut_faces[s];
            const Vec3 &a = band_.nodes[n[0]].at, &b = band_.nodes[n[1]].at, &c = band_.nodes[n[2]].at;
            const Vec3 normal = (b - a).cross(c - a);
            const double area2 = normal.squaredNorm();
            if (std::abs(normal.dot(corner - a)) > 0.5 * area2 / std::sqrt(std::sqrt(area2))) continue;
            double outside = 0;
            for (int k = 0; k < 3; ++k) {
                const Vec3 &p = band_.nodes[n[k]].at, &q = band_.nodes[n[(k + 1) % 3]].at;
                outside = std::max(outside, -(q - p).cross(corner - p).dot(normal) / area2);
            }
            if (outside < least) {
                least = outside;
                face = s;
            }
        }
        return {face, least};
    }

    /// Makes a corner of the patch a node of the interface, if the interface gets there.
    void place_corner(const Patch::Corner& corner) {
        check_cancelled();
        const auto [face, least] = face_at(corner.at);
        // Outside the mesh; but a faceted surface may pass a corner by.
        if (face < 0 || (least > 1e-6 && !std::isfinite(f_.tool->feature_size()))) return;
        Contact tools =
            Contact(f_.tool).with(patch_.sides[corner.sides[0]].get()).with(patch_.sides[corner.sides[1]].get());
        const auto seat = [&](int v, double enough) {
            Vec3 target = corner.at;
            // A node born in the corner itself is on its sides already; one of another corner is not for this one.
            if (!tools.includes(d_.contact[v]) || d_.contact[v].full() || !d_.contact[v].has(f_.tool)) return false;
            if (!d_.constraints.project(v, tools, target) || (target - corner.at).norm() > 10 * f_.tolerance)
                return false;
            return move(v, target, tools, std::numeric_limits<double>::infinity(), enough);
        };
        std::array<int, 3> nodes = band_.cut_faces[face];
        std::ranges::sort(nodes, {}, [&](int v) { return (band_.nodes[v].at - corner.at).norm(); });
        const double edge = length(nodes[0], nodes[1]);
        if ((band_.nodes[nodes[0]].at - corner.at).norm() < snap_reach * edge && seat(nodes[0], 0.1)) return;
        // A new node on the nearest edge, moved from there.
        const std::array<std::pair<int, int>, 3> sides{std::pair(nodes[0], nodes[1]), std::pair(nodes[0], nodes[2]),
                                                       std::pair(nodes[1], nodes[2])};
        std::vector<std::pair<double, std::pair<int, int>>> order;
        for (const auto& [a, b] : sides) {
            const Vec3 &p = band_.nodes[a].at, &q = band_.nodes[b].at;
            const double t = std::clamp((corner.at - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
            order.push_back({(corner.at - p - t * (q - p)).norm(), {a, b}});
        }
        std::ranges::sort(order);
        for (const auto& [distance, e] : order) {
            const Vec3 &p = band_.nodes[e.first].at, &q = band_.nodes[e.second].at;
            const double t = (corner.at - p).dot(q - p) / (q - p).squaredNorm();
            if (t < 0.05 || t > 0.95) continue;
            const int v = split(e.first, e.second, p + t * (q - p), f_.tool);
            if (seat(v, 0.01)) return;
            break;
        }
        for (const int v : nodes)
            if (seat(v, 0.01)) return;
        std::ostringstream message;
        message << "the corner of the crack front at (" << corner.at.transpose()
                << ") cannot be made a node: the mesh is too coarse there, or the corner too "
                << "close to a surface or border. Refine the mesh near it, or move the corner";
        throw QualityError(message.str());
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    const Patch& patch_;
    std::vector<double> value_;  // by band node: signed distance to the border
};

/// Throws QualityError when the interface does not get to a node on a corner of the patch.
void check_corners(const Workpiece& f, const Patch& patch) {
    const BandMesh& band = f.d.band;
    const auto on_corner = [&](int v) {
        return std::ranges::any_of(patch.corners, [&](const Patch::Corner& c) {
            return (c.at - band.nodes[v].at).norm() <= 100 * f.tolerance;
        });
    };
    for (int v = 0; v < band.size(); ++v)
        if (f.d.contact[v].count() == 3 && band.cut_faces.around(v).empty() && on_corner(v)) {
            std::ostringstream message;
            message << "the crack front cannot be led around its corner at (" << band.nodes[v].at.transpose()
                    << "): the mesh is too coarse there. Refine it near the corner first";
            throw QualityError(message.str());
        }
}

/// Inside the patch: its node farthest from the border is, or its middle when all are on it.
bool is_inside(const Workpiece& f, const Patch& patch, const auto& nodes) {
    double furthest = 0;
    Vec3 middle = Vec3::Zero();
    for (const int v : nodes) {
        middle += f.d.band.nodes[v].at / static_cast<double>(nodes.size());
        const auto tools = f.d.contact[v].tools();
        if (std::ranges::any_of(tools, [&](const Tool* t) { return patch.has(t); })) continue;
        const double d = patch.distance(f.d.band.nodes[v].at);
        if (std::abs(d) > std::abs(furthest)) furthest = d;
    }
    if (std::abs(furthest) <= f.tolerance) furthest = patch.distance(middle);
    return furthest < 0;
}

/// Whether some point of a triangle lies inside the patch: divided where it may, as no distance changes by more than
/// twice the way (once, where it is exact).
bool reaches_into(const Patch& patch, const Vec3& a, const Vec3& b, const Vec3& c, int depth) {
    const Vec3 middle = (a + b + c) / 3;
    const double off = patch.distance(middle);
    if (off < 0) return true;
    const double radius = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
    if (depth == 0 || off > 2 * radius) return false;
    const Vec3 ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
    return reaches_into(patch, a, ab, ca, depth - 1) || reaches_into(patch, b, bc, ab, depth - 1) ||
           reaches_into(patch, c, ca, bc, depth - 1) || reaches_into(patch, ab, bc, ca, depth - 1);
}

/// Whether some of the faces (edges of shells) on the tool reach into the patch, be it a ten thousandth of them.
bool meets_material(const BandMesh& band, const Patch& patch) {
    constexpr int depth = 14;
    const auto at = [&](int v) -> const Vec3& { return band.nodes[v].at; };
    for (int s = 0; s < band.cut_faces.size(); ++s) {
        if (!band.cut_faces.alive(s)) continue;
        const auto& v = band.cut_faces[s];
        if (reaches_into(patch, at(v[0]), at(v[1]), at(v[2]), depth)) return true;
    }
    for (int s = 0; s < band.cut_edges.size(); ++s) {
        if (!band.cut_edges.alive(s)) continue;
        const auto& v = band.cut_edges[s];
        if (reaches_into(patch, at(v[0]), at(v[1]), at(v[1]), depth)) return true;
    }
    return false;
}

/// Nodes that were moved onto the tool where it is not wanted after all go back to where they were, if elements allow
/// it; the others are relaxed with the crack's.
void send_home(Workpiece& f, std::vector<int> nodes) {
    for (bool any = true; any;) {
        any = false;
        for (int& v : nodes) {
            if (v < 0 || f.d.band.is_new(v)) continue;
            BandNode& node = f.d.band.nodes[v];
            if (node.at != node.start &&
                quality_around(f.d, v, node.start) < std::min(0.3, quality_around(f.d, v, node.at)))
                continue;
            node.at = node.start;
            v = -1;
            any = true;
        }
    }
    for (const int v : nodes)
        if (v >= 0 && f.d.band.nodes[v].movable()) f.released.push_back(v);
}

}  // namespace

bool part_closed_faces(Workpiece& f, const Patch& patch) {
    const int before = f.d.band.size();
    BandMesh& band = f.d.band;
    const auto on_front = [&](int v) {
        return std::ranges::any_of(f.d.contact[v].tools(), [&](const Tool* t) { return patch.has(t); });
    };
    const auto split = [&](int a, int b) {
        const Vec3 middle = (band.nodes[a].at + band.nodes[b].at) / 2;
        f.split_edge(a, b, f.d.fitted_split(a, b, f.tool->project(middle), f.tool).at, f.tool);
    };
    for (int s = 0; s < band.cut_faces.size(); ++s) {
        if (!band.cut_faces.alive(s) || !std::ranges::all_of(band.cut_faces[s], on_front)) continue;
        const std::array<int, 3> n = band.cut_faces[s];
        double longest = 0;
        int side = -1;
        for (int k = 0; k < 3; ++k) {
            const int a = n[k], b = n[(k + 1) % 3];
            const double length = (band.nodes[a].at - band.nodes[b].at).norm();
            if (length <= longest || (band.is_cut_border(a, b) && !f.d.constraints.is_skin_edge(band, a, b))) continue;
            longest = length;
            side = k;
        }
        if (side >= 0) split(n[side], n[(side + 1) % 3]);
    }
    for (int s = 0; s < band.cut_faces.size(); ++s)
        for (int k = 0; k < 3 && band.cut_faces.alive(s); ++k) {
            const int a = band.cut_faces[s][k], b = band.cut_faces[s][(k + 1) % 3];
            if (!on_front(a) || !on_front(b) || !band.is_cut_border(a, b) || !f.d.constraints.is_skin_edge(band, a, b))
                continue;
            if (patch.distance((band.nodes[a].at + band.nodes[b].at) / 2) < -10 * f.tolerance) split(a, b);
        }
    // An edge inside the crack from one node of the front to another would join the lips along it.
    for (int s = 0; s < band.cut_faces.size(); ++s)
        for (int k = 0; k < 3 && band.cut_faces.alive(s); ++k) {
            const int a = band.cut_faces[s][k], b = band.cut_faces[s][(k + 1) % 3];
            if (on_front(a) && on_front(b) && !band.is_cut_border(a, b)) split(a, b);
        }
    for (int s = 0; s < band.cut_edges.size(); ++s)
        if (band.cut_edges.alive(s) && std::ranges::all_of(band.cut_edges[s], on_front))
            split(band.cut_edges[s][0], band.cut_edges[s][1]);
    return f.d.band.size() > before;
}

void cut_border(Workpiece& f, const Patch& patch) {
    Stopwatch watch(f.seconds);
    BorderCutter(f, patch).run();
    watch.lap("front");
}

void keep_patch(Workpiece& f, const Patch& patch) {
    BandMesh& band = f.d.band;
    const auto too_coarse = [&](const std::string& why) {
        throw ToolError("the mesh is too coarse for the crack: " + why +
                        ". Refine the mesh near the crack front first, or make the crack larger");
    };
    const auto any_inside = [&](const auto& list) {
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s) && is_inside(f, patch, list[s])) return true;
        return false;
    };
    if (!any_inside(band.cut_faces) && !any_inside(band.cut_edges) && f.beam_nodes.empty()) {
        if (meets_material(band, patch)) too_coarse("no element face fits in it");
        throw ToolError(why_nothing_parts(f, Blade{f.tool, patch.distance, {}},
                                          "the crack lies outside the part: there is no material within its front. "
                                          "Move it into the material"));
    }
    const auto drop = [&](auto& list) {
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s) && !is_inside(f, patch, list[s])) list.remove(s);
    };
    drop(band.cut_faces);
    drop(band.cut_edges);
    double radius = std::numeric_limits<double>::infinity();
    for (const auto& side : patch.sides) radius = std::min(radius, side->feature_size());
    for (int s = 0; s < band.cut_faces.size(); ++s) {
        if (!band.cut_faces.alive(s)) continue;
        const auto& n = band.cut_faces[s];
        for (int k = 0; k < 3 && std::isfinite(radius); ++k) {
            const int a = n[k], b = n[(k + 1) % 3];
            const Contact both = f.d.contact[a].common(f.d.contact[b]);
            if (both.count() < 2) continue;
            const double off = std::abs(patch.distance((band.nodes[a].at + band.nodes[b].at) / 2));
            int faces = 0;
            for (const int t : band.cut_faces.around(a))
                faces += std::ranges::find(band.cut_faces[t], b) != band.cut_faces[t].end();
            if (faces == 1 && off > deepest_sag * radius)
                too_coarse("its front would be cut short by up to " + std::to_string(off));
        }
    }
    check_corners(f, patch);
    part_closed_faces(f, patch);
    std::vector<int> released;
    for (int v = 0; v < band.size(); ++v)
        if (f.d.contact[v] && band.cut_faces.around(v).empty() && band.cut_edges.around(v).empty()) {
            f.d.contact[v] = {};
            f.d.held_off[v] = 0;
            released.push_back(v);
        }
    send_home(f, released);
}

}  // namespace femscalpel
