// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/imprint.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <sstream>

#include "cancel.h"
#include "cutting/root.h"
#include "deformation/curved_shape.h"
#include "mesh/closest_point.h"
#include "mesh/stopwatch.h"

namespace femscalpel {
namespace {

/// As in snap.cpp: how far a node may be off a line to be moved onto it, and how far it may go, in its mean edge
/// length.
constexpr double snap_reach = 0.45;
constexpr double snap_slide = 1.0;
/// The same for stops, in the shortest edge of the line there.
constexpr double stop_reach = 0.45;
/// An edge that a line dips this deep through, in its own length, gets a node in between.
constexpr double dip = 0.15;
/// Nearer to a node of the line than this, in edges, a stop is that node, even if it cannot be moved.
constexpr double same_stop = 0.2;
/// A surface that stands this steep in a ribbon (sine of the angle between its normal and the direction in which the
/// ribbon stands) is not the one it stands on.
constexpr double lying = 0.4;
/// Nor is one that is this far off the line, in its edges.
constexpr double off_line = 0.6;

std::string place(const Vec3& x) {
    std::ostringstream out;
    out << "(" << x.transpose() << ")";
    return out.str();
}

/// Whether a face of BandMesh::skin is one of the surface, not of a border inside the material.
bool is_surface_face(const Deformable& d, int skin) {
    return d.band.skin.alive(skin) && !d.constraints.geometry().surfaces[d.band.skin.tag(skin)].internal;
}

void check_joined(const Deformable& d, int a, int b) {
    const BandMesh& band = d.band;
    const bool joined = std::ranges::any_of(band.skin.around(a), [&](int s) {
        return is_surface_face(d, s) && std::ranges::find(band.skin[s], b) != band.skin[s].end();
    });
    if (joined) return;
    throw QualityError("the seam cannot be made edges between " + place(band.nodes[a].at) + " and " +
                       place(band.nodes[b].at) +
                       ": the mesh is too coarse there, or something there holds its nodes. Refine the mesh there "
                       "first, or move the addition a little");
}

/// The nodes on a line, along it; `at_stop` as Workpiece::at_stop.
std::vector<int> line_nodes(const Workpiece& f, const ImprintLine& line, const std::vector<int>& at_stop) {
    const Ribbon& ribbon = *line.ribbon;
    std::vector<std::pair<double, int>> order;
    std::set<int> listed;
    const double slack = 1e-6 * ribbon.length();
    const auto list = [&](int v, double arc) {
        if (listed.insert(v).second) order.push_back({arc, v});
    };
    for (std::size_t k = 0; k < at_stop.size(); ++k)
        if (at_stop[k] >= 0) list(at_stop[k], line.stops[k]);
    for (int v = 0; v < f.d.band.size(); ++v) {
        if (!f.d.contact[v].has(&ribbon) || !f.d.band.in_use(v)) continue;
        const double arc = ribbon.foot(f.d.band.nodes[v].at).arc;
        if (ribbon.closed() || (arc >= -slack && arc <= ribbon.length() + slack)) list(v, arc);
    }
    std::ranges::sort(order);
    std::vector<int> out;
    out.reserve(order.size());
    for (const auto& [arc, v] : order) out.push_back(v);
    for (std::size_t k = 0; k + (ribbon.closed() ? 0 : 1) < out.size(); ++k)
        check_joined(f.d, out[k], out[(k + 1) % out.size()]);
    return out;
}

class Imprinter {
public:
    Imprinter(Workpiece& f, const ImprintLine& line, int tag, bool exact, std::vector<std::unique_ptr<Plane>>& planes)
        : f_(f),
          d_(f.d),
          band_(f.d.band),
          line_(line),
          ribbon_(*line.ribbon),
          tag_(tag),
          exact_(exact),
          planes_(planes) {}

    /// To be called before run() of any line: nodes that are known stay where they have to be.
    void take_known_nodes() {
        at_stop_.assign(line_.stops.size(), -1);
        std::map<Index, std::size_t> wanted_nodes;
        for (std::size_t s = 0; s < line_.known.size(); ++s)
            if (line_.known[s] >= 0) wanted_nodes[line_.known[s]] = s;
        if (wanted_nodes.empty()) return;
        for (int v = 0; v < band_.original_nodes(); ++v) {
            const auto found = wanted_nodes.find(band_.nodes[v].global);
            if (found == wanted_nodes.end()) continue;
            if (exact_) band_.nodes[v].at = wanted(found->second);
            hold(v, found->second);
        }
    }

    std::vector<int> run() {
        seat_end(0);
        if (!ribbon_.closed()) seat_end(line_.stops.size() - 1);
        measure();
        // Where edges are long for a bend, each round shows more of it.
        for (int round = 0; round < 6; ++round) {
            const bool dipped = split_dipping_edges();
            if (round > 0 && !dipped) break;
            snap_nodes();
            split_edges();
        }
        place_stops();
        const std::vector<int> nodes = chain();
        for (std::size_t k = 0; k + (ribbon_.closed() ? 0 : 1) < nodes.size(); ++k) {
            const int a = nodes[k], b = nodes[(k + 1) % nodes.size()];
            if (band_.cut_edges.find({a, b}) < 0) band_.cut_edges.add({a, b}, tag_);
        }
        return at_stop_;
    }

    /// The nodes on the line, along it.
    std::vector<int> chain() const { return line_nodes(f_, line_, at_stop_); }

private:
    bool is_surface(int skin) const { return is_surface_face(d_, skin); }

    const Vec3& at(int v) const { return band_.nodes[v].at; }
    double length(int a, int b) const { return (at(a) - at(b)).norm(); }

    /// Mean length of the surface's edges at a node.
    double surface_edge(int v) const {
        double sum = 0;
        int count = 0;
        for (const int s : band_.skin.around(v)) {
            if (!is_surface(s)) continue;
            for (const int w : band_.skin[s])
                if (w != v) {
                    sum += length(v, w);
                    ++count;
                }
        }
        return count ? sum / count : band_.mean_edge_length(v);
    }

    const Vec3& wanted(std::size_t stop) const { return line_.places[stop]; }

    /// Keeps a node at a stop from now on.
    void hold(int v, std::size_t stop) {
        const Ribbon::Foot foot = ribbon_.foot(wanted(stop));
        planes_.push_back(std::make_unique<Plane>(at(v), foot.tangent));
        Contact tools = d_.contact[v];
        if (!tools.full()) tools = tools.with(&ribbon_);
        if (!tools.full()) tools = tools.with(planes_.back().get());
        d_.hold_beside(v, tools);
        at_stop_[stop] = v;
        if (static_cast<std::size_t>(v) < value_.size()) value_[v] = 0;
    }

    bool is_held(int v) const { return d_.constraints[v].freedom == NodeFreedom::fixed; }

    /// Moves a node to a point on its surface (line), or to the closest there is on that, if that is as near as
    /// `close`.
    bool move(int v, Vec3 target, double enough, double close) {
        BandNode& node = band_.nodes[v];
        if (!node.movable()) return false;
        const Vec3 asked = target;
        if (!d_.constraints.project(v, {}, target) || (target - asked).norm() > close) return false;
        if (exact_) target = asked;
        if ((target - node.start).norm() > d_.constraints.leash(v)) return false;
        const double before = quality_around(d_, v, node.at), after = quality_around(d_, v, target);
        if (!(after >= std::min(enough, before / 4)) || !(after > 0) || !keeps_curved_shape(d_, v, target))
            return false;
        node.at = target;
        return true;
    }

    /// The face of the surface that is closest to a point, and the point of it.
    std::pair<int, Vec3> face_at(const Vec3& x) const {
        int best = -1;
        Vec3 foot = x, bary;
        double least = std::numeric_limits<double>::infinity();
        for (int s = 0; s < band_.skin.size(); ++s) {
            if (!is_surface(s)) continue;
            const auto& n = band_.skin[s];
            const Vec3 q = closest_on_triangle(at(n[0]), at(n[1]), at(n[2]), x, bary);
            if ((q - x).norm() >= least) continue;
            least = (q - x).norm();
            best = s;
            foot = q;
        }
        return {best, foot};
    }

    /// Makes an end of the line a node.
    void seat_end(std::size_t stop) {
        if (at_stop_[stop] >= 0) return;
        check_cancelled();
        const Vec3 x = wanted(stop);
        const auto [face, foot] = face_at(x);
        if (face < 0) fail_end(x);
        const std::array<int, 3> n = band_.skin[face];
        const double edge = (length(n[0], n[1]) + length(n[1], n[2]) + length(n[2], n[0])) / 3;
        if ((foot - x).norm() > off_line * edge) fail_end(x);
        const int v = seat(n, foot, x, edge);
        if (v < 0) fail_end(x);
        hold(v, stop);
    }

    [[noreturn]] void fail_end(const Vec3& x) const {
        throw QualityError(
            "the seam's end at " + place(x) +
            " cannot be made a node: the mesh is too coarse there, or the place too close to a corner or "
            "border. Refine the mesh there first, or move the addition a little");
    }

    /// A node of the surface at the point `foot` of a face, or -1: one of the face's moved there, or a new one.
    int seat(const std::array<int, 3>& n, const Vec3& foot, const Vec3& x, double edge) {
        std::array<int, 3> nodes = n;
        std::ranges::sort(nodes, {}, [&](int v) { return (at(v) - foot).norm(); });
        const double nearest = (at(nodes[0]) - foot).norm();
        const double close = std::max({10 * f_.tolerance, d_.rounding, 2 * (foot - x).norm(), 1e-6 * edge});
        if (nearest <= close) {
            if (exact_) band_.nodes[nodes[0]].at = x;
            return nodes[0];
        }
        if (is_held(nodes[0]) ? nearest < same_stop * edge / 4 : nearest < snap_reach * edge) {
            if (is_held(nodes[0]) || move(nodes[0], exact_ ? x : foot, 0.1, close)) return nodes[0];
        }
        // A new node on the nearest edge, moved from there.
        std::vector<std::tuple<double, double, int, int>> sides;
        for (int k = 0; k < 3; ++k) {
            const int a = nodes[k], b = nodes[(k + 1) % 3];
            const double t = std::clamp((foot - at(a)).dot(at(b) - at(a)) / (at(b) - at(a)).squaredNorm(), 0.0, 1.0);
            sides.push_back({(foot - at(a) - t * (at(b) - at(a))).norm(), t, a, b});
        }
        std::ranges::sort(sides);
        for (const auto& [off, t, a, b] : sides) {
            if (t < 0.02 || t > 0.98 || !(band_.nodes[a].movable() || band_.nodes[b].movable())) continue;
            // On a line that is kept it has to stay there.
            const bool kept = band_.creases.find({a, b}) >= 0;
            if (kept && off > std::max(close, same_stop * edge / 4)) continue;
            const int v = f_.split_edge(a, b, at(a) + t * (at(b) - at(a)), {});
            extend_values();
            if (move(v, exact_ ? x : foot, 0.01, close) || kept) return v;
            break;
        }
        for (const int v : nodes)
            if (!is_held(v) && move(v, exact_ ? x : foot, 0.01, close)) return v;
        return -1;
    }

    void extend_values() {
        for (int v = static_cast<int>(value_.size()); v < band_.size() && measured_; ++v) value_.push_back(value_of(v));
    }

    double value_of(int v) const {
        if (d_.contact[v].has(&ribbon_)) return 0;
        return ribbon_.distance(at(v));
    }

    /// Signed distances to the ribbon; what lies on it but for rounding is on it.
    void measure() {
        measured_ = true;
        value_.clear();
        extend_values();
        for (const int v : at_stop_)
            if (v >= 0) value_[v] = 0;
        const double close = std::max(f_.tolerance, d_.rounding);
        for (const int s : region())
            for (const int v : band_.skin[s])
                if (value_[v] != 0 && std::abs(value_[v]) <= close && within_ends(at(v)) && !d_.contact[v].full()) {
                    d_.contact[v] = d_.contact[v].with(&ribbon_);
                    value_[v] = 0;
                }
    }

    bool within_ends(const Vec3& x) const {
        if (ribbon_.closed()) return true;
        const double arc = ribbon_.foot(x).arc, slack = 1e-9 * ribbon_.length();
        return arc > -slack && arc < ribbon_.length() + slack;
    }

    /// Whether the line runs over a face, or along its border: it lies there, and reaches both sides of the ribbon.
    bool carries_line(int s) const {
        const auto& n = band_.skin[s];
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const int v : n) {
            low = std::min(low, value_[v]);
            high = std::max(high, value_[v]);
        }
        return low <= 0 && high >= 0 && lies_there(s);
    }

    /// Whether a face lies where the line is, as the surface it runs on does.
    bool lies_there(int s) const {
        const auto& n = band_.skin[s];
        const Vec3 middle = (at(n[0]) + at(n[1]) + at(n[2])) / 3,
                   normal = (at(n[1]) - at(n[0])).cross(at(n[2]) - at(n[0]));
        const double size = std::sqrt(normal.norm());
        const Ribbon::Foot foot = ribbon_.foot(middle);
        if (std::abs(normal.dot(foot.standing)) < lying * normal.norm()) return false;
        if (std::abs(foot.standing.dot(middle - foot.at)) > off_line * size) return false;
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (const int v : n) {
            const double arc = ribbon_.closed() ? 0 : ribbon_.foot(at(v)).arc;
            least = std::min(least, arc);
            most = std::max(most, arc);
        }
        return ribbon_.closed() || (most > 0 && least < ribbon_.length());
    }

    /// The faces of the surface that the line runs over: those joined to where it begins.
    std::vector<int> region() const {
        std::vector<int> out;
        std::deque<int> next;
        std::set<int> seen;
        const auto visit = [&](int s) {
            if (is_surface(s) && seen.insert(s).second && carries_line(s)) next.push_back(s);
        };
        for (const int v : at_stop_)
            if (v >= 0)
                for (const int s : band_.skin.around(v)) visit(s);
        // The line may but dip into a face, whose nodes are all on one side.
        for (int k = 0; k < 8 && ribbon_.closed(); ++k)
            if (const int near = face_at(ribbon_.at(k * ribbon_.length() / 8)).first; near >= 0)
                for (const int v : band_.skin[near])
                    for (const int s : band_.skin.around(v)) visit(s);
        while (!next.empty()) {
            const int s = next.front();
            next.pop_front();
            out.push_back(s);
            for (const int v : band_.skin[s])
                for (const int t : band_.skin.around(v)) visit(t);
        }
        std::ranges::sort(out);
        return out;
    }

    /// Halves edges that a bent line dips through without crossing; true if there was one.
    bool split_dipping_edges() {
        if (!std::isfinite(ribbon_.feature_size())) return false;
        std::set<std::pair<int, int>> dipping;
        for (int s = 0; s < band_.skin.size(); ++s)
            for (int k = 0; k < 3 && is_surface(s) && lies_there(s); ++k) {
                const auto [a, b] = std::minmax(band_.skin[s][k], band_.skin[s][(k + 1) % 3]);
                if (dips(a, b)) dipping.insert({a, b});
            }
        for (const auto& [a, b] : dipping) {
            const Contact tools = d_.edge_contact(a, b);
            f_.split_edge(a, b, d_.fitted_split(a, b, d_.along_edge(a, b, 0.5), tools).at, tools);
            extend_values();
        }
        return !dipping.empty();
    }

    /// Whether the line goes through an edge though its ends are not on different sides.
    bool dips(int a, int b) const {
        const double edge = length(a, b);
        if (value_[a] * value_[b] < 0 || std::min(std::abs(value_[a]), std::abs(value_[b])) > edge) return false;
        if (!band_.nodes[a].movable() && !band_.nodes[b].movable()) return false;
        const Vec3 middle = d_.along_edge(a, b, 0.5);
        if (!within_ends(middle)) return false;
        const double off = ribbon_.distance(middle), side = value_[a] != 0 ? value_[a] : value_[b];
        return side == 0 ? std::abs(off) > dip * edge : off * (side > 0 ? -1 : 1) > dip * edge;
    }

    /// The edges of the region that cross the line, longest first.
    std::vector<std::pair<int, int>> crossing_edges() const {
        std::set<std::pair<int, int>> found;
        for (const int s : region())
            for (int k = 0; k < 3; ++k) {
                const auto [a, b] = std::minmax(band_.skin[s][k], band_.skin[s][(k + 1) % 3]);
                if (value_[a] * value_[b] < 0 && within_ends(crossing(a, b))) found.insert({a, b});
            }
        std::vector<std::pair<int, int>> out(found.begin(), found.end());
        std::ranges::stable_sort(out, std::greater(), [&](const auto& e) { return length(e.first, e.second); });
        return out;
    }

    Vec3 crossing(int a, int b) const {
        const auto point = [&](double t) { return d_.along_edge(a, b, t); };
        return point(root_between(value_[a], value_[b], 1e-3 * f_.tolerance,
                                  [&](double t) { return ribbon_.distance(point(t)); }));
    }

    void snap_nodes() {
        std::set<int> ends;
        for (const auto& [a, b] : crossing_edges()) {
            ends.insert(a);
            ends.insert(b);
        }
        std::vector<std::tuple<double, int, double>> candidates;
        for (const int v : ends) {
            const double edge = surface_edge(v), ratio = std::abs(value_[v]) / edge;
            if (ratio < snap_reach && !d_.off_tool[v]) candidates.push_back({ratio, v, edge});
        }
        std::ranges::sort(candidates);
        for (const auto& [ratio, v, edge] : candidates) {
            check_cancelled();
            if (value_[v] != 0 && still_crosses(v)) snap(v, edge);
        }
    }

    bool still_crosses(int v) const {
        return std::ranges::any_of(band_.skin.around(v), [&](int s) {
            return is_surface(s) &&
                   std::ranges::any_of(band_.skin[s], [&](int w) { return value_[w] * value_[v] < 0; });
        });
    }

    bool snap(int v, double edge) {
        if (!band_.nodes[v].movable() || is_held(v) || d_.contact[v].full()) return false;
        Vec3 target = at(v);
        const Contact tools = d_.contact[v].with(&ribbon_);
        if (!d_.constraints.project(v, tools, target) || (target - at(v)).norm() > snap_slide * edge ||
            !within_ends(target) || too_near_a_stop(target, edge))
            return false;
        if ((target - band_.nodes[v].start).norm() > d_.constraints.leash(v)) return false;
        const double before = quality_around(d_, v, at(v)), after = quality_around(d_, v, target);
        if (!(after >= std::min(0.1, before / 4)) || !(after > 0) || !keeps_curved_shape(d_, v, target)) return false;
        band_.nodes[v].at = target;
        d_.contact[v] = tools;
        value_[v] = 0;
        return true;
    }

    /// Whether a point on the line is so near a node at a stop that an edge between them would be too short.
    bool too_near_a_stop(const Vec3& x, double edge) const {
        return std::ranges::any_of(at_stop_, [&](int v) { return v >= 0 && (at(v) - x).norm() < same_stop * edge; });
    }

    void split_edges() {
        for (const auto& [a, b] : crossing_edges()) {
            const Contact tools =
                d_.edge_contact(a, b).full() ? d_.edge_contact(a, b) : d_.edge_contact(a, b).with(&ribbon_);
            const int v = f_.split_edge(a, b, d_.fitted_split(a, b, crossing(a, b), tools).at, tools);
            extend_values();
            value_[v] = 0;
        }
    }

    /// Makes the stops between the ends nodes.
    void place_stops() {
        std::vector<std::pair<double, int>> line;  // nodes of the line by length
        const std::vector<int> nodes = chain();
        for (const int v : nodes) line.push_back({arc_of(v), v});
        // Near ones first, so that each node goes to the stop it is nearest to.
        std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
        std::set<int> taken;
        for (const int v : at_stop_)
            if (v >= 0) taken.insert(v);
        for (std::size_t s = 0; s < line_.stops.size(); ++s) {
            if (at_stop_[s] >= 0) continue;
            for (std::size_t k = 0; k < line.size(); ++k) {
                const double off = std::abs(ribbon_.arc_between(line[k].first, line_.stops[s]));
                if (off < spacing(s, line, k)) pairs.push_back({off, s, k});
            }
        }
        std::ranges::sort(pairs);
        for (const auto& [off, s, k] : pairs) {
            const int v = line[k].second;
            if (at_stop_[s] >= 0 || taken.contains(v)) continue;
            const double room = spacing(s, line, k);
            if (off > stop_reach * room) continue;
            const bool there = off <= std::max(f_.tolerance, 1e-9 * ribbon_.length());
            // Where the line bends, its nodes are its shape.
            const double same = (std::isfinite(ribbon_.feature_size()) ? 0.25 : 1) * same_stop;
            if (!there && !move_along(v, s) && off > same * room) continue;
            if (exact_) band_.nodes[v].at = wanted(s);
            taken.insert(v);
            hold(v, s);
        }
        for (std::size_t s = 0; s < line_.stops.size(); ++s)
            if (at_stop_[s] < 0) split_at(s);
    }

    double arc_of(int v) const {
        for (std::size_t s = 0; s < at_stop_.size(); ++s)
            if (at_stop_[s] == v) return line_.stops[s];
        return ribbon_.foot(at(v)).arc;
    }

    /// The shortest way from a stop, or from a node of the line, to the next of its kind.
    double spacing(std::size_t stop, const std::vector<std::pair<double, int>>& line, std::size_t node) const {
        double out = ribbon_.length();
        const auto look = [&](double a, double b) {
            const double way = std::abs(ribbon_.arc_between(a, b));
            if (way > 0) out = std::min(out, way);
        };
        const std::size_t n = line.size(), m = line_.stops.size();
        look(line[node].first, line[(node + 1) % n].first);
        look(line[node].first, line[(node + n - 1) % n].first);
        look(line_.stops[stop], line_.stops[(stop + 1) % m]);
        look(line_.stops[stop], line_.stops[(stop + m - 1) % m]);
        return out;
    }

    bool move_along(int v, std::size_t stop) {
        if (is_held(v)) return false;
        return move(v, wanted(stop), 0.1, 0.05 * surface_edge(v));
    }

    /// How far it is along the line from one length to another; round a closed line.
    double onward(double from, double to) const {
        const double way = to - from;
        return ribbon_.closed() ? way - std::floor(way / ribbon_.length()) * ribbon_.length() : way;
    }

    /// Splits the edge of the line that a stop is on.
    void split_at(std::size_t stop) {
        check_cancelled();
        const std::vector<int> nodes = chain();
        const double arc = line_.stops[stop];
        for (std::size_t k = 0; k + (ribbon_.closed() ? 0 : 1) < nodes.size(); ++k) {
            const int a = nodes[k], b = nodes[(k + 1) % nodes.size()];
            const double from = arc_of(a), here = onward(from, arc), whole = onward(from, arc_of(b));
            if (here < 0 || here > whole || whole <= 0) continue;
            const Contact tools = Contact(&ribbon_);
            const double t = here / whole;
            const Vec3 on = exact_ ? wanted(stop) : d_.fitted_split(a, b, d_.along_edge(a, b, t), tools).at;
            const int v = f_.split_edge(a, b, on, tools);
            extend_values();
            // The edge is but the chord of a bend.
            if (!exact_) move(v, wanted(stop), 0.05, 0.05 * surface_edge(v));
            hold(v, stop);
            return;
        }
        throw QualityError("the seam has no edge at " + place(wanted(stop)) +
                           " to make a node on: the mesh is too coarse there. Refine it there first");
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    const ImprintLine& line_;
    const Ribbon& ribbon_;
    int tag_;
    bool exact_;
    std::vector<std::unique_ptr<Plane>>& planes_;
    std::vector<int> at_stop_;
    std::vector<double> value_;  // signed distance to the ribbon by band node
    bool measured_ = false;
};

}  // namespace

void Imprint::run(Workpiece& f) {
    f.at_stop.clear();
    std::vector<Imprinter> imprinters;
    for (std::size_t k = 0; k < lines_.size(); ++k)
        imprinters.emplace_back(f, lines_[k], static_cast<int>(k), exact_, planes_).take_known_nodes();
    for (Imprinter& i : imprinters) f.at_stop.push_back(i.run());
}

std::vector<ImprintedLine> Imprint::result(const Workpiece& f) const {
    std::vector<ImprintedLine> out;
    for (std::size_t k = 0; k < lines_.size(); ++k)
        out.push_back({line_nodes(f, lines_[k], f.at_stop[k]), f.at_stop[k]});
    return out;
}

}  // namespace femscalpel
