// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/move_wall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "cancel.h"
#include "cutting/border_overlap.h"
#include "cutting/mend_curved.h"
#include "cutting/motion_error.h"
#include "cutting/remesh.h"
#include "cutting/skin_beside.h"
#include "cutting/slide_off.h"
#include "cutting/untangler.h"
#include "deformation/bar_network.h"
#include "deformation/relaxation.h"

namespace femscalpel {
namespace {

/// A step moves nodes by this part of the edges around them, at first; one that is smaller than that part of the first
/// is not tried.
constexpr double stride = 0.4, smallest_step = 1.0 / 64;
/// Elements that come out of a step worse than this, or than half of what they were, spoil it.
constexpr double spoilt = 0.08;
/// Elements worse than this are worked on.
constexpr double goal_of_steps = 0.22, goal_of_end = 0.3;

/// A wall that is moved into the material may be outside of it on its way for this part of an edge: facets of bent
/// surfaces differ from these by less.
constexpr double outside = 0.3;
/// A round wall whose chords are so many times as far off it as they were, and more by that part of their length, is
/// worth a word.
constexpr double flatter = 1.2, flatter_by = 1e-3;
/// So many steps, and so many for each that would do if nothing was in the way, are enough.
constexpr int least_bound = 60, bound_per_step = 6;
/// So many nodes for each of the input, and for each of the wall and edge length on its way: more are born only where
/// elements are drawn out between what moves and what cannot.
constexpr int nodes_per_node = 2, nodes_per_edge_moved = 4, more_edges = 10;

/// Elements beside a wall that moves by more edge lengths than this would be drawn out beyond all use.
constexpr double most_edges = 300;

std::string place_text(const Vec3& at) {
    std::ostringstream out;
    out << "(" << at.transpose() << ")";
    return out.str();
}

class Mover {
public:
    Mover(Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh)
        : f_(f),
          d_(f.d),
          band_(f.d.band),
          wall_(wall),
          motion_(motion),
          goals_(f, wall, motion, mesh),
          remesher_(f, mesh, [this](int v) { return slides(v); }),
          overlapped_before_(wall.faces || border_overlap(f.d)) {}

    MovedWall run() {
        MovedWall out;
        const double bound = std::min(spoilt, remesher_.worst().mean_ratio / 2);
        chords_off_ = chords_off([this](const Vec3& x) { return motion_.carried(x); })[0];
        double left = 1, step = first_step();
        check_paths();
        const double most_steps = least_bound + bound_per_step / step;
        const double most_nodes =
            nodes_per_node * static_cast<double>(band_.size()) +
            nodes_per_edge_moved * static_cast<double>(wall_nodes().size()) * (stride / step + more_edges);
        const double smallest = smallest_step * step;
        while (left > 0) {
            step = std::min(step, left);
            const std::vector<BandNode> before = band_.nodes;
            advance(step >= left ? 1 : step / left);
            const Remesher::Worst worst = remesher_.worst();
            if (!(worst.mean_ratio >= bound)) {
                crushed_ = worst.at;
                band_.nodes = before;
                step /= 2;
                if (step < smallest) refuse();
                continue;
            }
            crushed_ = worst.at;
            if (++out.steps > most_steps) refuse();
            left = step >= left ? 0 : left - step;
            if (left == 0) break;
            remesher_.run(goal_of_steps);
            if (band_.size() > most_nodes) refuse();
            goals_.add_nodes();
            step *= 1.5;
            step = std::min(step, first_step() * left);
        }
        finish();
        out.taken_out = remesher_.taken_out();
        return out;
    }

    /// Elements would be crushed for long before it shows that there is no way.
    void check_paths() const {
        if (first_step() * most_edges < stride) refuse_far();
        const SkinBeside skin = wall_.faces ? SkinBeside::of_solid(band_) : SkinBeside::of_shells(d_);
        const auto look = [&](const auto& list) {
            for (int s = 0; s < list.size(); ++s) {
                if (!list.alive(s)) continue;
                Vec3 from = Vec3::Zero(), to = from;
                for (const int v : list[s]) {
                    from += band_.nodes[v].at / static_cast<double>(list[s].size());
                    to += goals_[v] / static_cast<double>(list[s].size());
                }
                const double length = outside * band_.mean_edge_length(list[s][0]);
                if (const auto at = skin.exit(from, to, length, shell_normal(list[s]))) refuse_to_leave(*at);
            }
        };
        look(band_.cut_faces);
        look(band_.cut_edges);
        if (const auto at = slides_off(
                band_, [this](int v) { return goals_[v]; }, outside))
            refuse_to_slide_off(*at);
    }

private:
    bool on_wall(int v) const { return is_on_wall(band_, v); }

    /// Whether moving a node along what it keeps to could change that: bent lines and curved surfaces of which only
    /// points are known. Those that end at the wall change with it.
    bool is_bent(int v) const {
        const NodeConstraint& c = d_.constraints[v];
        if (d_.constraints.is_straight(c)) return false;
        if (c.freedom == NodeFreedom::curve) return !wall_.curves.contains(c.shape);
        return !wall_.surfaces.contains(c.shape);
    }

    /// Nodes of the wall are where they belong; once on their tool they may slide on it, but for those between two
    /// patches.
    bool slides(int v) const {
        if (!on_wall(v)) return !is_bent(v);
        return arrived_ && d_.contact[v] && !d_.constraints.is_held(v) && wall_tags(band_, v).size() == 1;
    }

    std::vector<int> wall_nodes() const {
        std::vector<int> out;
        for (int v = 0; v < band_.size(); ++v)
            if (band_.in_use(v) && on_wall(v)) out.push_back(v);
        return out;
    }

    /// The part of what is left that moves no node farther than its stride.
    double first_step() const {
        double most = 1;
        for (const int v : wall_nodes())
            most = std::max(most, (goals_[v] - band_.nodes[v].at).norm() / (stride * band_.mean_edge_length(v)));
        return 1 / most;
    }

    /// Of the shell that a part of the wall ends, in the input; zero in a solid.
    static Vec3 shell_normal(const std::array<int, 3>& /*face*/) { return Vec3::Zero(); }
    Vec3 shell_normal(const std::array<int, 2>& edge) const {
        for (const int t : band_.triangles.around(edge[0])) {
            const auto& n = band_.triangles[t];
            if (std::ranges::find(n, edge[1]) != n.end()) return d_.shell_normals[band_.triangles.origin(t)];
        }
        return Vec3::Zero();
    }

    void advance(double part) {
        const std::vector<int> wall = wall_nodes(), others = remesher_.movable();
        std::vector<Vec3> moves;
        for (const int v : wall) {
            Vec3 x = part == 1 ? goals_[v] : Vec3(band_.nodes[v].at + part * (goals_[v] - band_.nodes[v].at));
            if (part < 1 && !d_.constraints.is_straight(d_.constraints[v])) d_.constraints.project(v, {}, x);
            moves.push_back(x - band_.nodes[v].at);
        }
        const std::vector<Vec3> spread = bar_network_displacements(d_, wall, moves, others);
        for (std::size_t k = 0; k < wall.size(); ++k) band_.nodes[wall[k]].at += moves[k];
        if (part == 1)
            for (const int v : wall) band_.nodes[v].at = goals_[v];
        for (std::size_t k = 0; k < others.size(); ++k) {
            const int v = others[k];
            if (spread[k].isZero(0)) continue;
            Vec3 x = band_.nodes[v].at + spread[k];
            if (d_.constraints.project(v, d_.contact[v], x) && !d_.is_barred(v, x)) band_.nodes[v].at = x;
        }
        if (remesher_.worst().mean_ratio < spoilt) untangle(d_, others, 2 * spoilt);
        relax(d_, remesher_.strained());
    }

    /// How far chords of a wall that is carried are off the curved surfaces it is to lie on, in the mean; and their
    /// length.
    std::array<double, 2> chords_off(auto moved) const {
        double sum = 0, lengths = 0, chords = 0;
        if (!band_.mid_nodes.empty()) return {};  // edges of second order follow it
        const auto look = [&](const auto& list) {
            for (int s = 0; s < list.size(); ++s) {
                const Tool* tool = list.alive(s) && !motion_.onto ? motion_.tools[list.tag(s)] : nullptr;
                if (!tool || tool->kind() == "plane") continue;
                for (std::size_t k = 0; k < list[s].size(); ++k, ++chords) {
                    const Vec3 &a = band_.nodes[list[s][k]].at, &b = band_.nodes[list[s][(k + 1) % list[s].size()]].at;
                    const double length = (moved(a) - moved(b)).norm();
                    sum += length * std::abs(tool->distance(moved((a + b) / 2)));
                    lengths += length;
                }
            }
        };
        look(band_.cut_faces);
        look(band_.cut_edges);
        return lengths > 0 ? std::array{sum / lengths, lengths / chords} : std::array{0.0, 0.0};
    }

    void warn_of_chords() {
        const auto [off, length] = chords_off([](const Vec3& x) { return x; });
        if (off <= flatter * chords_off_ + flatter_by * length) return;
        std::ostringstream text;
        text << "the wall is less round than it was, as its nodes had to make room: in the mean its edges are " << off
             << " off the surface it lies on, which were " << chords_off_
             << ". Move it less, or refine the mesh there first";
        f_.warnings.push_back(text.str());
    }

    /// Edges of patches that keep their shape are as bent as before, for their size.
    void scale_bulges() {
        if (!d_.mids.any() || motion_.carried.factor == 1) return;
        std::set<std::array<int, 2>> edges;
        const auto look = [&](const auto& list) {
            for (int s = 0; s < list.size(); ++s)
                if (list.alive(s) && !motion_.tools[list.tag(s)] && !motion_.follows[list.tag(s)])
                    for (std::size_t k = 0; k < list[s].size(); ++k)
                        for (std::size_t j = 0; j < k; ++j)
                            edges.insert({std::min(list[s][j], list[s][k]), std::max(list[s][j], list[s][k])});
        };
        look(band_.cut_faces);
        look(band_.cut_edges);
        for (const auto& [a, b] : edges) d_.mids.set_bulge(a, b, motion_.carried.factor * d_.mids.bulge(a, b));
    }

    void finish() {
        scale_bulges();
        for (const int v : wall_nodes()) d_.contact[v] = goals_.tools(v);
        arrived_ = true;
        relax(d_, remesher_.strained());
        remesher_.run(goal_of_end);
        mend_curved(f_, false);
        warn_of_chords();
        check_sides();
        if (const auto at = overlapped_before_ ? std::nullopt : border_overlap(d_)) refuse_to_slide_off(*at);
    }

    /// Unit normal of a part of the wall, out of the material.
    Vec3 normal(const std::array<int, 3>& v) const {
        const Vec3& a = band_.nodes[v[0]].at;
        return (band_.nodes[v[1]].at - a).cross(band_.nodes[v[2]].at - a).normalized();
    }
    Vec3 normal(const std::array<int, 2>& v) const {
        const Vec3 &a = band_.nodes[v[0]].at, &b = band_.nodes[v[1]].at;
        Vec3 out = Vec3::Zero();
        for (const int t : band_.triangles.around(v[0])) {
            const auto& n = band_.triangles[t];
            if (std::ranges::find(n, v[1]) == n.end()) continue;
            out = (b - a).cross(d_.shell_normals[band_.triangles.origin(t)]).normalized();
            for (const int w : n)
                if (w != v[0] && w != v[1] && out.dot(band_.nodes[w].at - a) > 0) out = -out;
        }
        return out;
    }

    /// The material is on one side of each tool: else the wall, such as all around a hole on a plane, lies on itself.
    void check_sides() const {
        std::map<const Tool*, std::array<bool, 2>> sides;
        const auto look = [&](const auto& list) {
            for (int s = 0; s < list.size(); ++s) {
                if (!list.alive(s)) continue;
                const Tool* tool = motion_.tools[list.tag(s)];
                if (!tool) continue;
                Vec3 middle = Vec3::Zero();
                for (const int v : list[s]) middle += band_.nodes[v].at / static_cast<double>(list[s].size());
                sides[tool][normal(list[s]).dot(tool->normal(middle)) > 0] = true;
            }
        };
        look(band_.cut_faces);
        look(band_.cut_edges);
        for (const auto& [tool, side] : sides)
            if (side[0] && side[1])
                throw MotionError(
                    "the wall would lie on itself there, with material on both sides of the " + tool->kind(),
                    motion_.parameter, band_.nodes[wall_nodes().front()].start);
    }

    [[noreturn]] void refuse() const {
        throw MotionError(
            "the wall cannot be moved so far: elements beside it would be turned inside out, first near " +
                place_text(crushed_) +
                ", as there is no room for it, or what is beside it is kept where it is (groups, "
                "feature lines)",
            motion_.parameter, crushed_);
    }

    [[noreturn]] void refuse_far() const {
        const std::vector<int> nodes = wall_nodes();
        const int v = *std::ranges::max_element(
            nodes, {}, [&](int w) { return (goals_[w] - band_.nodes[w].at).norm() / band_.mean_edge_length(w); });
        std::ostringstream message;
        message << "the wall cannot be moved so far: from " << place_text(band_.nodes[v].at) << " to "
                << place_text(goals_[v]) << ", more than " << most_edges
                << " times the length of the edges there, which elements beside it cannot follow";
        throw MotionError(message.str(), motion_.parameter, band_.nodes[v].at);
    }

    [[noreturn]] void refuse_to_slide_off(const Vec3& at) const {
        throw MotionError(
            "the wall cannot be moved so far: its rim would pass the end of what it slides on (a surface, a line or a "
            "border of groups) before it is at " +
                place_text(at),
            motion_.parameter, at);
    }

    [[noreturn]] void refuse_to_leave(const Vec3& at) const {
        throw MotionError(
            "the wall cannot be moved so far: it would pass through the part, and leave it on another side near " +
                place_text(at),
            motion_.parameter, at);
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    const Wall& wall_;
    const WallMotion& motion_;
    WallGoals goals_;
    Remesher remesher_;
    bool overlapped_before_;  // the border of shells, as lips of a crack do
    double chords_off_ = 0;   // before, for the size after
    bool arrived_ = false;
    Vec3 crushed_ = Vec3::Zero();  // where the worst element of the last step was in the input
};

}  // namespace

MovedWall move_wall(Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh) {
    return Mover(f, wall, motion, mesh).run();
}

void check_way(Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh) {
    Mover(f, wall, motion, mesh).check_paths();
}

}  // namespace femscalpel
