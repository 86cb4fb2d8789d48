// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/reshape_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "cancel.h"
#include "deformation/fitted_tool.h"
#include "groups/covered.h"
#include "groups/group_nodes.h"
#include "groups/nearest_group.h"
#include "mesh/stopwatch.h"
#include "operators/revolved_share.h"
#include "tools/cone.h"
#include "tools/cylinder.h"
#include "tools/plane.h"
#include "tools/sphere.h"
#include "tools/torus.h"

namespace femscalpel {
namespace {

/// Shares are tried in so many steps.
constexpr int steps = 20;
/// Nodes whose distances from a tool differ by less than this part of the motion are equally far from it.
constexpr double equally_far = 1e-6;
/// A wall is on a surface if within this part of its size; as find_tools() has it, for rounded coordinates.
constexpr double on_surface = 1e-6;

std::string number_text(double x) {
    std::array<char, 40> out{};
    (void)std::snprintf(out.data(), out.size(), "%.10g", x == 0 ? 0.0 : x);
    return out.data();
}

std::string vector_text(const Vec3& x) {
    return "(" + number_text(x.x()) + ", " + number_text(x.y()) + ", " + number_text(x.z()) + ")";
}

/// `value` with no more digits than a thousandth of `range` needs.
double in_few_digits(double value, double range) {
    if (!(range > 0)) return value;
    const double digit = std::pow(10, 3 - std::floor(std::log10(range)));
    return std::isfinite(digit) ? std::round(value * digit) / digit : value;
}

Vec3 in_few_digits(Vec3 x, double range) {
    for (int k = 0; k < 3; ++k) x[k] = in_few_digits(x[k], range);
    return x;
}

std::vector<Vec3> places_of(const Mesh& mesh, GroupIndex group) {
    const std::vector<char> member = nodes_of_group(mesh, group);
    std::vector<Vec3> out;
    for (std::size_t n = 0; n < member.size(); ++n)
        if (member[n]) out.push_back(mesh.points[n]);
    return out;
}

/// The surface of the wall, of a solid; none if it is no plane, cylinder or sphere.
std::unique_ptr<Tool> surface_of(const Mesh& mesh, GroupIndex group) {
    std::vector<Vec3> points, normals;
    Eigen::AlignedBox3d box;
    try {
        const Covered covered = covered_by(mesh, group);
        if (!covered.faces) return nullptr;
        for (const auto& part : covered.parts) {
            for (const Index n : part) box.extend(points.emplace_back(mesh.points[n]));
            const Vec3 *corner = &points[points.size() - 3], first = corner[1] - corner[0];
            normals.push_back(first.cross(corner[2] - corner[0]).normalized());
        }
    } catch (const UnsupportedElementError&) {
        return nullptr;  // of quadrangles
    }
    return fitted_tool(points, normals, on_surface * box.diagonal().norm(), {});
}

/// A surface like `target`, but `off` from it on the positive side.
std::unique_ptr<Tool> parallel_to(const Tool& target, double off) {
    if (const auto* plane = dynamic_cast<const Plane*>(&target))
        return std::make_unique<Plane>(plane->origin() + in_few_digits(Vec3(off * plane->unit_normal()), std::abs(off)),
                                       plane->unit_normal());
    if (const auto* cylinder = dynamic_cast<const Cylinder*>(&target))
        return std::make_unique<Cylinder>(cylinder->origin(), cylinder->unit_axis(),
                                          in_few_digits(cylinder->radius() + off, std::abs(off)));
    if (const auto* sphere = dynamic_cast<const Sphere*>(&target))
        return std::make_unique<Sphere>(sphere->center(), in_few_digits(sphere->radius() + off, std::abs(off)));
    if (const auto* torus = dynamic_cast<const Torus*>(&target)) {
        const double minor = in_few_digits(torus->minor_radius() + off, std::abs(off));
        if (minor > 0 && minor < torus->major_radius())
            return std::make_unique<Torus>(torus->center(), torus->unit_axis(), torus->major_radius(), minor);
    }
    return nullptr;
}

Vec3 unit_between(const Vec3& from, const Vec3& to, double share) {
    return ((1 - share) * (from.dot(to) < 0 ? Vec3(-from) : from) + share * to).normalized();
}

/// A surface between two of the same kind. `middle`: of the wall.
std::unique_ptr<Tool> between(const Tool& from, const Tool& to, double share, const Vec3& middle) {
    const auto mix = [&](const auto& a, const auto& b) { return (1 - share) * a + share * b; };
    if (from.kind() != to.kind()) return nullptr;
    if (const auto* a = dynamic_cast<const Plane*>(&from), *b = dynamic_cast<const Plane*>(&to); a && b) {
        const Vec3 start = a->project(middle), end = b->project(middle);
        return std::make_unique<Plane>(in_few_digits(Vec3(mix(start, end)), (end - start).norm()),
                                       unit_between(a->unit_normal(), b->unit_normal(), share));
    }
    if (const auto* a = dynamic_cast<const Cylinder*>(&from), *b = dynamic_cast<const Cylinder*>(&to); a && b) {
        const Vec3 on_axis = b->origin() + (middle - b->origin()).dot(b->unit_axis()) * b->unit_axis();
        const Vec3 start = a->origin() + (on_axis - a->origin()).dot(a->unit_axis()) * a->unit_axis();
        const double range = (on_axis - start).norm() + std::abs(b->radius() - a->radius());
        return std::make_unique<Cylinder>(in_few_digits(Vec3(mix(start, on_axis)), range),
                                          unit_between(a->unit_axis(), b->unit_axis(), share),
                                          in_few_digits(mix(a->radius(), b->radius()), range));
    }
    if (const auto* a = dynamic_cast<const Sphere*>(&from), *b = dynamic_cast<const Sphere*>(&to); a && b) {
        const double range = (b->center() - a->center()).norm() + std::abs(b->radius() - a->radius());
        return std::make_unique<Sphere>(in_few_digits(Vec3(mix(a->center(), b->center())), range),
                                        in_few_digits(mix(a->radius(), b->radius()), range));
    }
    return nullptr;
}

std::string tool_text(const Tool& tool) {
    if (const auto* plane = dynamic_cast<const Plane*>(&tool))
        return "onto=Plane(" + vector_text(plane->origin()) + ", " + vector_text(plane->unit_normal()) + ")";
    if (const auto* cylinder = dynamic_cast<const Cylinder*>(&tool))
        return "onto=Cylinder(" + vector_text(cylinder->origin()) + ", " + vector_text(cylinder->unit_axis()) + ", " +
               number_text(cylinder->radius()) + ")";
    if (const auto* cone = dynamic_cast<const Cone*>(&tool))
        return "onto=Cone(" + vector_text(cone->origin()) + ", " + vector_text(cone->unit_axis()) + ", " +
               number_text(cone->radius()) + ", " + number_text(cone->half_angle()) + ")";
    if (const auto* torus = dynamic_cast<const Torus*>(&tool))
        return "onto=Torus(" + vector_text(torus->center()) + ", " + vector_text(torus->unit_axis()) + ", " +
               number_text(torus->major_radius()) + ", " + number_text(torus->minor_radius()) + ")";
    const auto& sphere = dynamic_cast<const Sphere&>(tool);
    return "onto=Sphere(" + vector_text(sphere.center()) + ", " + number_text(sphere.radius()) + ")";
}

std::unique_ptr<Tool> tool_on_the_way(const Mesh& mesh, GroupIndex group, const Tool& target, double share) {
    const std::vector<Vec3> wall = places_of(mesh, group);
    if (wall.empty()) return nullptr;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    Vec3 middle = Vec3::Zero();
    for (const Vec3& x : wall) {
        least = std::min(least, target.distance(x));
        most = std::max(most, target.distance(x));
        middle += x / static_cast<double>(wall.size());
    }
    if (most - least <= equally_far * std::max(std::abs(least), std::abs(most)))
        if (auto parallel = parallel_to(target, (1 - share) * (least + most) / 2)) return parallel;
    Eigen::AlignedBox3d box;
    for (const Vec3& x : wall) box.extend(x);
    if (auto revolved = revolved_between(wall, target, share, on_surface * box.diagonal().norm())) return revolved;
    const std::unique_ptr<Tool> from = surface_of(mesh, group);
    return from ? between(*from, target, share, middle) : nullptr;
}

}  // namespace

std::optional<PartOfMotion> part_of_motion(const Mesh& mesh, GroupIndex group, const ReshapeOptions& options,
                                           double share) {
    PartOfMotion out{.options = options, .tool = {}, .text = {}};
    if (options.by) {
        out.options.by = in_few_digits(Vec3(share * *options.by), options.by->norm());
        out.text = "by=" + vector_text(*out.options.by);
    } else if (options.scale) {
        const double more = options.scale->factor - 1;
        out.options.scale->factor = in_few_digits(1 + share * more, std::abs(more));
        out.text = "scale=(" + number_text(out.options.scale->factor) + ", " + vector_text(options.scale->centre) + ")";
    } else {
        out.tool = tool_on_the_way(mesh, group, *options.onto, share);
        if (!out.tool) return {};
        out.options.onto = out.tool.get();
        out.text = tool_text(*out.tool);
    }
    return out;
}

std::string where_text(const Mesh& mesh, const std::string& wall, const MotionError& error) {
    const NearestGroup near = nearest_group(mesh, error.at(), wall);
    if (near.name.empty()) return ".";
    const std::string away = number_text(in_few_digits(near.distance, near.distance)) + " away";
    return ". The nearest other group is '" + near.name + "', " + (near.distance <= 1e-9 ? "there" : away) + ".";
}

namespace {

/// Finds the largest share of a motion that works.
class ShareSearch {
public:
    ShareSearch(const Mesh& mesh, GroupIndex group, const ReshapeOptions& options, double longest)
        : mesh_(mesh), group_(group), options_(options), longest_(longest) {}

    /// Halves what is between `works` and `fails`, in steps. False when a motion has no parts, or time is up.
    bool run(const MotionAttempt& attempt, int first) {
        for (int next = first; fails - works > 1; next = (works + fails) / 2) {
            const std::optional<PartOfMotion> part =
                part_of_motion(mesh_, group_, options_, static_cast<double>(next) / steps);
            if (!part) return false;
            const std::optional<bool> done = try_it(attempt, part->options);
            if (!done) return false;
            (*done ? works : fails) = next;
            if (*done) text = part->text;
        }
        return true;
    }

    int works = 0, fails = steps;
    std::string text;  ///< of the share that works

private:
    /// Nothing when time is up.
    std::optional<bool> try_it(const MotionAttempt& attempt, const ReshapeOptions& part) const {
        try {
            const CancelScope until(CancelToken{}, [this] { return Stopwatch::since(started_) > longest_; });
            attempt(part);
            return true;
        } catch (const Cancelled&) {
            check_cancelled();  // by the caller
            return {};
        } catch (const Error&) {
            return false;
        }
    }

    const Mesh& mesh_;
    GroupIndex group_;
    const ReshapeOptions& options_;
    double longest_;  // in seconds
    Stopwatch::Time started_ = Stopwatch::now();
};

}  // namespace

std::string advice_on_motion(const Mesh& mesh, GroupIndex group, const ReshapeOptions& options,
                             const MotionAttempt& look, const MotionAttempt& work, double longest) {
    ShareSearch search(mesh, group, options, longest);
    const bool looked = search.run(look, steps - 1);
    // What there is a way for is the most that can work. The less a wall moves, the sooner it is known.
    const int most = std::exchange(search.works, 0);
    const bool ended = looked && (most == 0 || search.run(work, (most + 1) / 2));
    const auto percent = [](int share) { return std::to_string(share * 100 / steps) + " % of the motion"; };
    if (search.works > 0)
        return " " + percent(search.works) + " works" + (ended ? ": " : ", and perhaps more: ") + search.text;
    if (search.fails == 1) return " Not even " + percent(1) + " works: move something else";
    return " Move it less" + (search.fails < steps ? ": " + percent(search.fails) + " is too much" : "");
}

}  // namespace femscalpel
