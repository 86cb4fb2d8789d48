// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/revolved_share.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "tools/cone.h"
#include "tools/cylinder.h"
#include "tools/torus.h"

namespace femscalpel {
namespace {

/// A profile that widens by less than this for each length along the axis is a cylinder's.
constexpr double upright = 1e-9;
/// Numbers are given so exactly, in the part of the way that they change on.
constexpr double digits = 1e-4;

using Vec2 = Eigen::Vector2d;

double in_steps(double value, double range) {
    if (!(range > 0)) return value;
    const double step = std::pow(10, std::floor(std::log10(range * digits)));
    return std::round(value / step) * step;
}

/// Points by their distance from an axis and their place along it.
std::vector<Vec2> profile_of(std::span<const Vec3> points, const Vec3& origin, const Vec3& axis) {
    std::vector<Vec2> out;
    out.reserve(points.size());
    for (const Vec3& x : points) {
        const double along = (x - origin).dot(axis);
        out.push_back({(x - origin - along * axis).norm(), along});
    }
    return out;
}

/// A profile's straight line: the radius at the place 0, and how it grows along the axis.
std::optional<Vec2> line_through(const std::vector<Vec2>& profile, double tolerance) {
    Eigen::MatrixX2d a(static_cast<Eigen::Index>(profile.size()), 2);
    Eigen::VectorXd b(a.rows());
    for (Eigen::Index k = 0; k < a.rows(); ++k) {
        a.row(k) = Vec2(1, profile[static_cast<std::size_t>(k)][1]).transpose();
        b[k] = profile[static_cast<std::size_t>(k)][0];
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixX2d> solver(a);
    if (solver.rank() < 2) return {};
    const Vec2 line = solver.solve(b);
    if ((a * line - b).cwiseAbs().maxCoeff() > tolerance) return {};
    return line;
}

struct Circle {
    Vec2 centre;
    double radius;
};

/// A profile's circle.
std::optional<Circle> circle_through(const std::vector<Vec2>& profile, double tolerance) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : profile) middle += p / static_cast<double>(profile.size());
    Eigen::MatrixX3d a(static_cast<Eigen::Index>(profile.size()), 3);
    Eigen::VectorXd b(a.rows());
    for (Eigen::Index k = 0; k < a.rows(); ++k) {
        const Vec2 p = profile[static_cast<std::size_t>(k)] - middle;
        a.row(k) << 2 * p[0], 2 * p[1], 1;
        b[k] = p.squaredNorm();
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> solver(a);
    if (solver.rank() < 3) return {};
    const Eigen::Vector3d found = solver.solve(b);
    const Circle out{found.head<2>() + middle, std::sqrt(std::max(0.0, found[2] + found.head<2>().squaredNorm()))};
    const auto is_off = [&](const Vec2& p) { return std::abs((p - out.centre).norm() - out.radius) > tolerance; };
    if (std::ranges::any_of(profile, is_off)) return {};
    return out;
}

std::unique_ptr<Tool> towards_cone(std::span<const Vec3> wall, const Cone& target, double share, double tolerance) {
    const std::vector<Vec2> profile = profile_of(wall, target.origin(), target.unit_axis());
    const std::optional<Vec2> from = line_through(profile, tolerance);
    if (!from) return nullptr;
    const Vec2 to(target.radius(), std::tan(target.half_angle() * std::numbers::pi / 180));
    const Vec2 line = (1 - share) * *from + share * to;
    // Where the wall is, it has a radius.
    double middle = 0;
    for (const Vec2& p : profile) middle += p[1] / static_cast<double>(profile.size());
    middle = in_steps(middle, std::abs(middle));
    const double range = std::abs((*from - to).dot(Vec2(1, middle))),
                 radius = in_steps(line.dot(Vec2(1, middle)), range);
    if (!(radius > 0)) return nullptr;
    const Vec3 at = target.origin() + middle * target.unit_axis();
    const double angle = std::atan(std::abs(line[1])) * 180 / std::numbers::pi,
                 turned = std::atan(std::abs(to[1] - (*from)[1])) * 180 / std::numbers::pi;
    if (std::abs(line[1]) < upright) return std::make_unique<Cylinder>(at, target.unit_axis(), radius);
    return std::make_unique<Cone>(at, line[1] > 0 ? target.unit_axis() : Vec3(-target.unit_axis()), radius,
                                  in_steps(angle, turned));
}

std::unique_ptr<Tool> towards_torus(std::span<const Vec3> wall, const Torus& target, double share, double tolerance) {
    const auto from = circle_through(profile_of(wall, target.center(), target.unit_axis()), tolerance);
    if (!from) return nullptr;
    const Vec2 to(target.major_radius(), 0);
    const double range = (from->centre - to).norm() + std::abs(from->radius - target.minor_radius());
    const Vec2 centre = (1 - share) * from->centre + share * to;
    const double major = in_steps(centre[0], range), along = in_steps(centre[1], range),
                 minor = in_steps((1 - share) * from->radius + share * target.minor_radius(), range);
    if (!(minor > 0 && minor < major)) return nullptr;
    return std::make_unique<Torus>(target.center() + along * target.unit_axis(), target.unit_axis(), major, minor);
}

}  // namespace

std::unique_ptr<Tool> revolved_between(std::span<const Vec3> wall, const Tool& target, double share, double tolerance) {
    if (const auto* cone = dynamic_cast<const Cone*>(&target)) return towards_cone(wall, *cone, share, tolerance);
    if (const auto* torus = dynamic_cast<const Torus*>(&target)) return towards_torus(wall, *torus, share, tolerance);
    return nullptr;
}

}  // namespace femscalpel
