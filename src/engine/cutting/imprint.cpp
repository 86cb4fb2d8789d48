// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/imprint.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cancel.h"
#include "cutting/surface_line.h"
#include "deformation/curved_shape.h"
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
/// And if there is no other way than this, even if the end is not on the line that holds the node.
constexpr double beside_line = 0.025;
/// How often faces are divided to make an end of a line a node.
constexpr int most_rounds = 4;

class Imprinter : public SurfaceLine {
public:
    Imprinter(Workpiece& f, const ImprintLine& line, int tag, bool exact, std::vector<std::unique_ptr<Plane>>& planes)
        : SurfaceLine(f, line, exact, planes), tag_(tag) {}

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
        if (line_.only_stops) {
            for (std::size_t s = 0; s < line_.stops.size(); ++s) seat_end(s);
            return at_stop_;
        }
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
            // The nodes are where those of another mesh are, off the curve that the edge is on.
            if (exact_ && !band_.mid_nodes.empty()) d_.mids.straighten(a, b);
        }
        return at_stop_;
    }

private:
    /// Makes an end of the line a node.
    void seat_end(std::size_t stop) {
        if (at_stop_[stop] >= 0) return;
        check_cancelled();
        const Vec3 x = wanted(stop);
        // Where a node cannot be moved there, the faces are smaller after each round.
        for (int round = 0; round < most_rounds; ++round) {
            const int nodes = band_.size();
            const auto [face, foot] = face_at(x);
            if (face < 0) break;
            const std::array<int, 3> n = band_.skin[face];
            const double edge = (length(n[0], n[1]) + length(n[1], n[2]) + length(n[2], n[0])) / 3;
            if ((foot - x).norm() > off_line * edge) break;
            const int v = seat(n, foot, x, edge);
            if (v >= 0) return hold(v, stop);
            if (band_.size() == nodes) break;
        }
        fail_end(x);
    }

    [[noreturn]] void fail_end(const Vec3& x) const {
        throw QualityError(
            "the seam's end at " + point_text(x) +
            " cannot be made a node: the mesh is too coarse there, or the place too close to a corner or "
            "border. Refine the mesh there first, or move the addition a little");
    }

    /// A node of the surface at the point `foot` of a face, or -1: one of the face's moved there, or a new one.
    int seat(const std::array<int, 3>& n, const Vec3& foot, const Vec3& x, double edge) {
        std::array<int, 3> nodes = n;
        std::ranges::sort(nodes, {}, [&](int v) { return (at(v) - foot).norm(); });
        const double nearest = (at(nodes[0]) - foot).norm();
        const double close =
            std::max({10 * f_.tolerance, d_.rounding, 2 * (foot - x).norm(), 1e-6 * edge, 1.5 * sag(n)});
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
        // Beside a line that is kept its nodes are as good as there.
        if (nearest < beside_line * edge) {
            move(nodes[0], foot, 0.01, nearest);
            return nodes[0];
        }
        return -1;
    }

    /// How far the surface of second-order elements is off a face.
    double sag(const std::array<int, 3>& n) const {
        double out = 0;
        for (std::size_t k = 0; k < 3 && !band_.mid_nodes.empty(); ++k) {
            const int a = n[k], b = n[(k + 1) % 3];
            out = std::max(out, (mid_side(d_, a, b).at - (at(a) + at(b)) / 2).norm());
        }
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
        line.reserve(nodes.size());
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
            // An edge that is there already stays where it is, also if that is a curve beside the line.
            const bool kept = d_.mids.is_kept(a, b);
            const Contact tools = kept ? Contact() : Contact(&ribbon_);
            const double t = here / whole;
            const Vec3 on = exact_ ? wanted(stop) : d_.fitted_split(a, b, d_.along_edge(a, b, t), tools).at;
            const int v = f_.split_edge(a, b, on, tools);
            extend_values();
            if (kept)
                for (const int end : {a, b}) d_.mids.keep(end, v);
            // The edge is but the chord of a bend.
            if (!exact_ && !kept) move(v, wanted(stop), 0.05, 0.05 * surface_edge(v));
            hold(v, stop);
            return;
        }
        throw QualityError("the seam has no edge at " + point_text(wanted(stop)) +
                           " to make a node on: the mesh is too coarse there. Refine it there first");
    }

    int tag_;
};

}  // namespace

void Imprint::keep_edges(Workpiece& f) const {
    std::map<Index, int> band_node;
    for (int v = 0; v < f.d.band.original_nodes(); ++v) band_node.emplace(f.d.band.nodes[v].global, v);
    const auto node = [&](Index known) {
        const auto found = known < 0 ? band_node.end() : band_node.find(known);
        return found == band_node.end() ? -1 : found->second;
    };
    for (const ImprintLine& line : lines_) {
        if (line.only_stops) continue;
        std::vector<int> nodes;  // other stops may be between them
        for (const Index known : line.known)
            if (const int v = node(known); v >= 0) nodes.push_back(v);
        for (std::size_t k = 0; k + (line.ribbon->closed() ? 0 : 1) < nodes.size(); ++k) {
            const int a = nodes[k], b = nodes[(k + 1) % nodes.size()];
            if (a == b || !are_joined(f.d, a, b)) continue;
            f.kept_edges.insert(std::minmax(a, b));
            if (!exact_) f.d.mids.keep(a, b);
        }
    }
}

void Imprint::run(Workpiece& f) {
    f.at_stop.clear();
    f.bound_at_stop.clear();
    std::vector<Imprinter> imprinters;
    for (std::size_t k = 0; k < lines_.size(); ++k)
        imprinters.emplace_back(f, lines_[k], static_cast<int>(k), exact_, planes_).take_known_nodes();
    for (Imprinter& i : imprinters) f.at_stop.push_back(i.run());
}

std::vector<ImprintedLine> Imprint::result(const Workpiece& f) const {
    std::vector<ImprintedLine> out;
    for (std::size_t k = 0; k < lines_.size(); ++k)
        out.push_back({lines_[k].only_stops ? f.at_stop[k] : line_nodes(f, lines_[k], f.at_stop[k]), f.at_stop[k]});
    return out;
}

}  // namespace femscalpel
