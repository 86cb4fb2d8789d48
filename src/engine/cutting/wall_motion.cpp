// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/wall_motion.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <tuple>

#include "cancel.h"
#include "cutting/motion_error.h"
#include "mesh/closest_point.h"

namespace femscalpel {
namespace {

/// A wall that is carried may end so far beside a curved surface that its nodes keep to, in edge lengths: the facets of
/// both differ by as much.
constexpr double beside_curved = 0.1;
/// Coordinates off by less than this part of the size have not been rounded.
constexpr double exact_fit = 1e-11;

SurfaceSample sample_of(const Workpiece& f, const Wall& wall, const Wall::Patch& patch) {
    const KeptGeometry& g = f.d.constraints.geometry();
    if (wall.faces) return sample_of(g, patch.parts);
    SurfaceSample out;
    for (const int part : patch.parts) {
        const KeptGeometry::Segment& s = g.segments[part];
        out.points.insert(out.points.end(), s.end.begin(), s.end.end());
        if (s.curved) out.points.push_back(s.mid);
        for (const int t : f.d.band.triangles.around(s.node[0]))
            if (std::ranges::find(f.d.band.triangles[t], s.node[1]) != f.d.band.triangles[t].end())
                out.normals.push_back((s.end[1] - s.end[0]).cross(f.d.shell_normals[t]).normalized());
    }
    return out;
}

/// Finds the surfaces of patches. Those of one plane, cylinder or sphere, which borders of groups or the edges of
/// coarse facets part, have one where coordinates were rounded or it takes iterations: each by itself would be a little
/// off the other's, and nodes between them could not be on both.
struct Fitter {
    struct Fitted {
        SurfaceSample sample;
        std::vector<std::size_t> patches;
        std::unique_ptr<Tool> tool;
    };

    void add(std::size_t patch, SurfaceSample sample) {
        Fitted fitted{std::move(sample), {patch}, {}};
        fitted.tool = fitted_tool(fitted.sample.points, fitted.sample.normals, tolerance, carried);
        if (fitted.tool && (rounded || fitted.tool->kind() != "plane"))
            for (Fitted& other : all)
                if (join(other, fitted)) return;
        all.push_back(std::move(fitted));
    }

    bool join(Fitted& other, const Fitted& fitted) const {
        if (!other.tool || other.tool->kind() != fitted.tool->kind()) return false;
        SurfaceSample both = other.sample;
        both.points.insert(both.points.end(), fitted.sample.points.begin(), fitted.sample.points.end());
        both.normals.insert(both.normals.end(), fitted.sample.normals.begin(), fitted.sample.normals.end());
        auto tool = fitted_tool(both.points, both.normals, tolerance, carried);
        const auto is_along = [&](const SurfaceSample& s) {
            return tool->normal(carried(s.points[0])).dot(s.normals[0]) > 0;
        };
        if (!tool || tool->kind() != fitted.tool->kind() || is_along(other.sample) != is_along(fitted.sample))
            return false;
        other.sample = std::move(both);
        other.patches.push_back(fitted.patches[0]);
        other.tool = std::move(tool);
        return true;
    }

    double tolerance;
    Similarity carried;
    bool rounded;
    std::vector<Fitted> all;
};

/// The directions in which the normals of a wall point, as a projector.
Eigen::Matrix3d directions_across(const std::vector<Vec3>& normals) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(), out = spread;
    for (const Vec3& n : normals) spread += n * n.transpose() / static_cast<double>(normals.size());
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    for (int k = 0; k < 3; ++k)
        if (axes.eigenvalues()[k] > 1e-6) out += axes.eigenvectors().col(k) * axes.eigenvectors().col(k).transpose();
    return out;
}

}  // namespace

void find_tools(const Workpiece& f, const Wall& wall, WallMotion& motion) {
    motion.follows.clear();
    motion.tools.clear();
    for (const Wall::Patch& p : wall.patches) {
        motion.follows.push_back(p.follows);
        motion.tools.push_back(p.follows ? nullptr : motion.onto);
    }
    if (motion.onto) return;
    const KeptGeometry& g = f.d.constraints.geometry();
    Fitter fitter{std::max(1e-8 * g.size, g.rounding), motion.carried, g.rounding > exact_fit * g.size, {}};
    for (std::size_t k = 0; k < wall.patches.size(); ++k) {
        if (wall.patches[k].follows) continue;
        SurfaceSample sample = sample_of(f, wall, wall.patches[k]);
        if (!wall.faces) {
            const int t = f.d.band.triangles.around(g.segments[wall.patches[k].parts[0]].node[0])[0];
            double_across(sample, f.d.shell_normals[t], g.size);
        }
        fitter.add(k, std::move(sample));
    }
    std::vector<Vec3> normals;
    for (Fitter::Fitted& fitted : fitter.all) {
        for (const std::size_t k : fitted.patches) motion.tools[k] = fitted.tool.get();
        if (!fitted.tool)
            normals.insert(normals.end(), fitted.sample.normals.begin(), fitted.sample.normals.end());
        else
            for (const Vec3& x : fitted.sample.points) normals.push_back(fitted.tool->normal(motion.carried(x)));
        motion.own.push_back(std::move(fitted.tool));
    }
    motion.across = directions_across(normals);
}

WallGoals::WallGoals(const Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh)
    : f_(f),
      motion_(motion),
      goal_(static_cast<std::size_t>(f.d.band.size()), Vec3::Zero()),
      plain_(goal_),
      mesh_(mesh) {
    std::vector<int> leading;
    std::ranges::copy_if(wall.nodes, std::back_inserter(leading), [&](int v) { return !follows(v); });
    for (const int v : leading) {
        const Vec3& at = f.d.band.nodes[v].at;
        const Vec3 move = motion.onto ? Vec3(Vec3::Zero()) : Vec3(motion.across * (motion.carried(at) - at));
        Vec3 x = at + move;
        if (!f.d.constraints.project(NodeConstraint{}, tools(v), x)) x = at + move;
        plain_[v] = goal_[v] = x;
    }
    // Those that can be but in one place first, then those that slide along what is beside the wall.
    for (const int known : {0, 1, 2}) {
        std::vector<int> nodes;
        for (const int v : leading)
            if (freedom(v) == known) nodes.push_back(v);
        for (const int v : nodes) {
            check_cancelled();
            const std::optional<Vec3> x = place(v, goal_[v]);
            if (!x) refuse(v);
            goal_[v] = *x;
        }
        if (known < 2) spread(leading, known);
    }
    if (!motion.onto && std::ranges::all_of(leading, [&](int v) {
            return (goal_[v] - f.d.band.nodes[v].at).norm() <= 1e-9 * f.d.constraints.geometry().size;
        }))
        throw ToolError("the motion runs along the wall, or out of its shell: nothing would move", motion.parameter);
    place_following(wall);
}

/// Whether a node is on no other patches than such that follow.
bool WallGoals::follows(int node) const {
    const std::vector<int> tags = wall_tags(f_.d.band, node);
    return !tags.empty() && std::ranges::all_of(tags, [&](int tag) { return motion_.follows[tag]; });
}

/// Nodes of patches that follow go as the nearest point where these meet the others does; along what is beside them.
void WallGoals::place_following(const Wall& wall) {
    const BandMesh& band = f_.d.band;
    std::vector<std::array<int, 2>> seam;
    const auto look = [&](const auto& list) {
        for (int s = 0; s < list.size(); ++s) {
            if (!motion_.follows[list.tag(s)]) continue;
            std::vector<int> ends;
            for (const int v : list[s])
                if (!follows(v)) ends.push_back(v);
            if (ends.size() == 1) seam.push_back({ends[0], ends[0]});
            if (ends.size() > 1) seam.push_back({ends[0], ends[1]});
        }
    };
    look(band.cut_faces);
    look(band.cut_edges);
    for (const int v : wall.nodes) {
        if (!follows(v)) continue;
        check_cancelled();
        const Vec3& at = band.nodes[v].at;
        double nearest = std::numeric_limits<double>::infinity();
        Vec3 move = Vec3::Zero();
        for (const auto& [a, b] : seam) {
            const Vec3 &pa = band.nodes[a].at, &pb = band.nodes[b].at;
            const Vec3 on = closest_on_segment(pa, pb, at);
            if ((on - at).squaredNorm() >= nearest) continue;
            nearest = (on - at).squaredNorm();
            const double t = a == b ? 0 : (on - pa).norm() / (pb - pa).norm();
            const Vec3 ma = goal_[a] - pa, mb = goal_[b] - pb, between = (1 - t) * ma + t * mb;
            // Around a round wall it is as long between the ends as it is there.
            move = between.normalized() * ((1 - t) * ma.norm() + t * mb.norm());
        }
        Vec3 x = at + move;
        if (!f_.d.constraints.project(f_.d.constraints[v], {}, x)) refuse(v);
        if (f_.d.constraints[v].freedom == NodeFreedom::fixed) {
            if (move.norm() > 1e-9 * f_.d.constraints.geometry().size) refuse(v);
            x = at;
        }
        goal_[v] = x;
    }
}

/// How many directions the wall's node can still slide in, once it is there.
int WallGoals::freedom(int node) const {
    const NodeFreedom of = f_.d.constraints[node].freedom;
    if (of == NodeFreedom::fixed || of == NodeFreedom::curve) return 0;
    const std::size_t tags = wall_tags(f_.d.band, node).size();
    return of == NodeFreedom::surface ? (tags > 1 ? 0 : 1) : tags > 1 ? 1 : 2;
}

/// Nodes of more freedom go aside as those around them do, by which each wants to be the mean of its neighbours on the
/// wall.
void WallGoals::spread(const std::vector<int>& nodes, int known_freedom) {
    constexpr int most_sweeps = 400;
    const BandMesh& band = f_.d.band;
    struct Unknown {
        int node;
        std::vector<std::pair<int, double>> bars;
    };
    std::vector<Unknown> unknown;
    std::vector<Vec3> aside(goal_.size(), Vec3::Zero());
    double largest = 0;
    for (const int v : nodes) {
        aside[v] = goal_[v] - plain_[v];
        if (freedom(v) <= known_freedom) {
            largest = std::max(largest, aside[v].norm());
            continue;
        }
        std::map<int, double> bars;
        const auto look = [&](const auto& list) {
            for (const int s : list.around(v))
                for (const int w : list[s])
                    if (w != v) bars[w] = 1 / (band.nodes[w].at - band.nodes[v].at).norm();
        };
        look(band.cut_faces);
        look(band.cut_edges);
        unknown.push_back({v, {bars.begin(), bars.end()}});
    }
    if (largest <= 1e-9 * f_.d.constraints.geometry().size) return;
    double change = largest;
    for (int sweep = 0; sweep < most_sweeps && change > 1e-3 * largest; ++sweep) {
        check_cancelled();
        change = 0;
        for (const Unknown& u : unknown) {
            Vec3 sum = Vec3::Zero();
            double weight = 0;
            for (const auto& [w, bar] : u.bars) {
                sum += bar * aside[w];
                weight += bar;
            }
            change = std::max(change, (sum / weight - aside[u.node]).norm());
            aside[u.node] = sum / weight;
        }
    }
    for (const Unknown& u : unknown) goal_[u.node] = plain_[u.node] + aside[u.node];
}

Contact WallGoals::tools(int node) const {
    Contact out;
    for (const int tag : wall_tags(f_.d.band, node))
        if (motion_.tools[tag] && !out.full()) out = out.with(motion_.tools[tag]);
    return out;
}

/// Nothing where there is none nearby.
std::optional<Vec3> WallGoals::place(int node, const Vec3& guess) const {
    const NodeConstraints& constraints = f_.d.constraints;
    const NodeConstraint& c = constraints[node];
    const Contact on = tools(node);
    Vec3 x = guess;
    if (on) {
        if (c.freedom == NodeFreedom::fixed) x = f_.d.band.nodes[node].at;
        if (!constraints.project(node, on, x)) return {};
        for (const Tool* t : on.tools())
            if (t->bounded() && t->beyond(x) > 1e-6 * constraints.geometry().size) return {};
        return x;
    }
    if (c.freedom == NodeFreedom::free) return x;
    if (c.freedom == NodeFreedom::fixed)
        return (x - f_.d.band.nodes[node].at).norm() <= 1e-9 * constraints.geometry().size ? std::optional(x)
                                                                                           : std::nullopt;
    if (constraints.is_straight(c)) {
        Vec3 on_it = x;
        constraints.project(c, {}, on_it);
        if ((on_it - x).norm() > 1e-6 * f_.d.band.mean_edge_length(node)) return {};
        return on_it;
    }
    if (constraints.distance(c, x) > beside_curved * f_.d.band.mean_edge_length(node)) return {};
    return x;
}

void WallGoals::refuse(int node) const {
    const BandNode& of = f_.d.band.nodes[node];
    std::ostringstream message;
    message << "node " << mesh_.node_ids[of.global] << " of the wall, at (" << of.start.transpose()
            << "), cannot get there: ";
    if (f_.d.constraints[node].freedom == NodeFreedom::fixed)
        message << "surfaces or lines beside the wall meet in it, and hold it";
    else if (tools(node))
        message << "what is beside the wall and the surface it is to lie on do not meet near it";
    else
        message
            << "the surfaces beside the wall do not run along the motion, as they must unless onto=, a tool, is given";
    throw MotionError(message.str(), motion_.parameter, of.start);
}

void WallGoals::add_nodes() {
    const BandMesh& band = f_.d.band;
    for (int v = static_cast<int>(goal_.size()); v < band.size(); ++v) {
        goal_.push_back(band.nodes[v].at);
        if (!is_on_wall(band, v)) continue;
        const auto& [a, b] = band.births[v - band.original_nodes()];
        const Vec3 between = (goal_[a] + goal_[b]) / 2 + (band.nodes[v].at - (band.nodes[a].at + band.nodes[b].at) / 2);
        const std::optional<Vec3> x = place(v, between);
        goal_[v] = x ? *x : Vec3((goal_[a] + goal_[b]) / 2);
    }
}

}  // namespace femscalpel
