// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/move_wall.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "cancel.h"
#include "cutting/mend_curved.h"
#include "cutting/remesh.h"
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
/// So many steps, and so many for each that would do if nothing was in the way, are enough.
constexpr int least_bound = 60, bound_per_step = 6;
/// So many nodes for each of the input, and for each of the wall and edge length on its way: more are born only where
/// elements are drawn out between what moves and what cannot.
constexpr int nodes_per_node = 2, nodes_per_edge_moved = 4, more_edges = 10;

/// The skin around a wall, without it, to ask where a path leaves the material.
class SkinBeside {
public:
    explicit SkinBeside(const BandMesh& band) : band_(band) {
        std::vector<int> faces;
        std::vector<Eigen::AlignedBox3d> boxes;
        for (int s = 0; s < band.skin.size(); ++s) {
            if (!band.skin.alive(s)) continue;
            const Vec3 out = outwards(s);
            if (out.isZero(0)) continue;
            faces.push_back(static_cast<int>(outwards_.size()));
            slots_.push_back(s);
            outwards_.push_back(out);
            boxes.emplace_back(corner(s, 0));
            boxes.back().extend(corner(s, 1)).extend(corner(s, 2));
        }
        tree_.init(faces.begin(), faces.end(), boxes.begin(), boxes.end());
    }

    /// Where a path that leads into the material leaves it for longer than `length`, if it does.
    std::optional<Vec3> exit(const Vec3& from, const Vec3& to, double length) const {
        Hits hits{*this, from, to - from, Eigen::AlignedBox3d(from).extend(to), {}};
        Eigen::BVIntersect(tree_, hits);
        std::ranges::sort(hits.found);
        for (std::size_t k = 0; k < hits.found.size(); ++k) {
            const auto& [at, leaves] = hits.found[k];
            if (!leaves && k == 0) return {};  // it led out from the beginning
            const double next = k + 1 < hits.found.size() ? hits.found[k + 1].first : 1;
            if (leaves && (next - at) * (to - from).norm() > length) return Vec3(from + at * (to - from));
        }
        return {};
    }

private:
    struct Hits {
        // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVIntersect() calls them.
        bool intersectVolume(const Eigen::AlignedBox3d& b) const { return b.intersects(box); }
        bool intersectObject(int face) {
            const int s = skin.slots_[face];
            const Vec3 &a = skin.corner(s, 0), ab = skin.corner(s, 1) - a, ac = skin.corner(s, 2) - a;
            // Möller & Trumbore, "Fast, minimum storage ray/triangle intersection", J. Graphics Tools 2, 1997
            const Vec3 p = way.cross(ac);
            const double volume = ab.dot(p);
            if (volume == 0) return false;
            const Vec3 d = from - a, q = d.cross(ab);
            const double u = d.dot(p) / volume, v = way.dot(q) / volume, at = ac.dot(q) / volume;
            if (u >= 0 && v >= 0 && u + v <= 1 && at > 0 && at <= 1)
                found.emplace_back(at, way.dot(skin.outwards_[face]) > 0);
            return false;
        }
        // NOLINTEND(readability-identifier-naming)

        const SkinBeside& skin;
        Vec3 from, way;
        Eigen::AlignedBox3d box;
        std::vector<std::pair<double, bool>> found;  // how far along the way, and whether it leaves the material there
    };

    const Vec3& corner(int slot, int k) const { return band_.nodes[band_.skin[slot][k]].at; }

    /// Normal of a face out of its tetrahedron; zero for one between two.
    Vec3 outwards(int slot) const {
        const auto& face = band_.skin[slot];
        Vec3 out = Vec3::Zero();
        int tetras = 0;
        for (const int t : band_.tetras.around(face[0])) {
            const auto& n = band_.tetras[t];
            const auto has = [&](int v) { return std::ranges::find(n, v) != n.end(); };
            if (!has(face[1]) || !has(face[2])) continue;
            ++tetras;
            const Vec3& a = corner(slot, 0);
            out = (corner(slot, 1) - a).cross(corner(slot, 2) - a);
            for (const int v : n)
                if (std::ranges::find(face, v) == face.end() && out.dot(band_.nodes[v].at - a) > 0) out = -out;
        }
        return tetras == 1 ? out : Vec3::Zero();
    }

    const BandMesh& band_;
    std::vector<int> slots_;
    std::vector<Vec3> outwards_;
    Eigen::KdBVH<double, 3, int> tree_;
};

class Mover {
public:
    Mover(Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh)
        : f_(f),
          d_(f.d),
          band_(f.d.band),
          wall_(wall),
          motion_(motion),
          goals_(f, wall, motion, mesh),
          remesher_(f, mesh, [this](int v) { return slides(v); }) {}

    MovedWall run() {
        MovedWall out;
        const double bound = std::min(spoilt, remesher_.worst() / 2);
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
            if (!(remesher_.worst() >= bound)) {
                band_.nodes = before;
                step /= 2;
                if (step < smallest) refuse();
                continue;
            }
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

    /// Elements would be crushed for long before it shows that there is no way.
    void check_paths() const {
        if (!wall_.faces) return;
        const SkinBeside skin(band_);
        for (int s = 0; s < band_.cut_faces.size(); ++s) {
            if (!band_.cut_faces.alive(s)) continue;
            Vec3 from = Vec3::Zero(), to = from;
            for (const int v : band_.cut_faces[s]) {
                from += band_.nodes[v].at / 3;
                to += goals_[v] / 3;
            }
            const double length = outside * band_.mean_edge_length(band_.cut_faces[s][0]);
            if (const auto at = skin.exit(from, to, length)) refuse_to_leave(*at);
        }
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
        if (remesher_.worst() < spoilt) untangle(d_, others, 2 * spoilt);
        relax(d_, remesher_.strained());
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
        check_sides();
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
                throw ToolError("the wall would lie on itself there, with material on both sides of the " +
                                    tool->kind() + ". Move less of it, or elsewhere",
                                motion_.parameter);
    }

    [[noreturn]] void refuse() const {
        std::ostringstream message;
        message
            << "the wall cannot be moved so far: elements beside it would be turned inside out, as there is no room "
               "for it, or what is beside it is kept where it is (groups, feature lines). Move it less";
        throw ToolError(message.str(), motion_.parameter);
    }

    [[noreturn]] void refuse_to_leave(const Vec3& at) const {
        std::ostringstream message;
        message
            << "the wall cannot be moved so far: it would pass through the part, and leave it on another side near ("
            << at.transpose() << "). Move it less";
        throw ToolError(message.str(), motion_.parameter);
    }

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    const Wall& wall_;
    const WallMotion& motion_;
    WallGoals goals_;
    Remesher remesher_;
    bool arrived_ = false;
};

}  // namespace

MovedWall move_wall(Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh) {
    return Mover(f, wall, motion, mesh).run();
}

}  // namespace femscalpel
