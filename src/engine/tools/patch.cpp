// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "error.h"
#include "tools/checks.h"
#include "tools/cylinder.h"
#include "tools/elliptic_cylinder.h"
#include "tools/plane.h"
#include "words.h"

namespace femscalpel {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Plane& plane_for(const Tool& tool, const char* shape) {
    const auto* plane = dynamic_cast<const Plane*>(&tool);
    if (!plane)
        throw ToolError(std::string("within: a ") + shape + " lies in a plane, but the tool is a " + tool.kind(),
                        "within");
    return *plane;
}

/// `x`, put exactly on the plane; it must lie on it but for rounding against `size`.
Vector3d on_plane(const Plane& plane, const Vector3d& x, double size, const std::string& what) {
    if (std::abs(plane.distance(x)) > 1e-6 * size) {
        std::ostringstream message;
        message << "within: " << what << " is off the plane by " << std::abs(plane.distance(x))
                << "; give a point of the plane";
        throw ToolError(message.str(), "within");
    }
    return plane.project(x);
}

/// `direction` within the plane.
Vector3d along_plane(const Plane& plane, const Vector3d& direction, const std::string& what) {
    const Vector3d in = direction - plane.unit_normal().dot(direction) * plane.unit_normal();
    if (in.norm() < 1e-6)
        throw ToolError("within: " + what + " is normal to the plane; give one that lies in it", "within");
    return in.normalized();
}

/// Half the shortest of a polygon's sides and of the distances between its corners and the sides they are not on.
double half_width(const std::vector<Vector2d>& corners) {
    const std::size_t count = corners.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count; ++k) {
        const Vector2d &a = corners[k], along = corners[(k + 1) % count] - a;
        least = std::min(least, along.norm());
        for (std::size_t j = 2; j < count; ++j) {
            const Vector2d& p = corners[(k + j) % count];
            const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
            least = std::min(least, (p - a - t * along).norm());
        }
    }
    return least / 2;
}

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Positive when the corners go round counterclockwise.
double signed_area(const std::vector<Vector2d>& corners) {
    double area = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) area += cross(corners[k], corners[(k + 1) % corners.size()]) / 2;
    return area;
}

/// Whether the sides a-b and b-c are folded back on each other.
bool folded(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    const Vector2d p = a - b, q = c - b;
    return std::abs(cross(p, q)) <= 1e-9 * p.norm() * q.norm() && p.dot(q) > 0;
}

/// Whether the segments a-b and c-d cross or touch.
bool crossing(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
    return cross(b - a, c - a) * cross(b - a, d - a) <= 0 && cross(d - c, a - c) * cross(d - c, b - c) <= 0;
}

void refuse_crossing_sides(const std::vector<Vector2d>& corners) {
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) {
            const Vector2d &a = corners[i], &b = corners[(i + 1) % count], &c = corners[j],
                           &d = corners[(j + 1) % count];
            const bool bad = j == i + 1                 ? folded(a, b, d)
                             : i == 0 && j == count - 1 ? folded(b, a, c)
                                                        : crossing(a, b, c, d);
            if (bad)
                throw ToolError("polygon: sides " + std::to_string(i + 1) + " and " + std::to_string(j + 1) +
                                    " cross or touch; give the corners in order around it",
                                "within");
        }
}

/// A polygon in coordinates of its plane, about its first corner.
struct FlatPolygon {
    Vector3d origin, u, v;
    std::vector<Vector2d> corners;

    /// The border's point nearest to a point: its distance, negative inside, and the side it is on.
    struct Nearest {
        double distance;
        int side;
    };

    FlatPolygon(const Plane& plane, const std::vector<Vector3d>& at)
        : origin(at[0]), u(plane.unit_normal().unitOrthogonal()), v(plane.unit_normal().cross(u)) {
        for (const Vector3d& x : at) corners.push_back(flat(x));
    }

    Vector2d flat(const Vector3d& x) const { return {u.dot(x - origin), v.dot(x - origin)}; }

    Nearest nearest(const Vector3d& x) const {
        const Vector2d p = flat(x);
        Nearest best{std::numeric_limits<double>::infinity(), 0};
        bool inside = false;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Vector2d &a = corners[k], &b = corners[(k + 1) % corners.size()];
            const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
            const double d = (p - a - t * (b - a)).norm();
            if (d < best.distance) best = {d, static_cast<int>(k)};
            if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
                inside = !inside;
        }
        if (inside) best.distance = -best.distance;
        return best;
    }
};

/// A patch with a single side.
Patch one_side(std::unique_ptr<Tool> tool) {
    Patch patch;
    patch.distance = [t = tool.get()](const Vector3d& x) { return t->distance(x); };
    patch.side = [](const Vector3d&) { return 0; };
    patch.sides.push_back(std::move(tool));
    return patch;
}

}  // namespace

bool Patch::has(const Tool* tool) const {
    return std::ranges::any_of(sides, [&](const auto& s) { return s.get() == tool; });
}

Disk::Disk(const Vector3d& center, double radius)
    : center_(checked_point(center, {"disk", "center"})), radius_(checked_length(radius, {"disk", "radius"})) {}

Patch Disk::on(const Tool& tool) const {
    const Plane& plane = plane_for(tool, "disk");
    Patch patch = one_side(std::make_unique<Cylinder>(on_plane(plane, center_, radius_, "the disk's center"),
                                                      plane.unit_normal(), radius_));
    patch.feature_size = radius_;
    return patch;
}

Ellipse::Ellipse(const Vector3d& center, double first, double second, const Vector3d& direction)
    : center_(checked_point(center, {"ellipse", "center"})),
      first_(checked_length(first, {"ellipse", "half_axes", "first half axis"})),
      second_(checked_length(second, {"ellipse", "half_axes", "second half axis"})),
      direction_(checked_direction(direction, {"ellipse", "direction"})) {}

Patch Ellipse::on(const Tool& tool) const {
    const Plane& plane = plane_for(tool, "ellipse");
    Patch patch = one_side(std::make_unique<EllipticCylinder>(
        on_plane(plane, center_, std::max(first_, second_), "the ellipse's center"), plane.unit_normal(),
        along_plane(plane, direction_, "the ellipse's direction"), first_, second_));
    patch.feature_size = std::min(first_, second_);
    return patch;
}

HalfPlane::HalfPlane(const Vector3d& origin, const Vector3d& direction)
    : origin_(checked_point(origin, {"half plane", "origin"})),
      direction_(checked_direction(direction, {"half plane", "direction"})) {}

Patch HalfPlane::on(const Tool& tool) const {
    const Plane& plane = plane_for(tool, "half plane");
    return one_side(
        std::make_unique<Plane>(plane.project(origin_), -along_plane(plane, direction_, "the half plane's direction")));
}

Polygon::Polygon(std::vector<Vector3d> corners) : corners_(std::move(corners)) {
    if (corners_.size() < 3)
        throw ToolError(
            "polygon: " + counted(static_cast<std::int64_t>(corners_.size()), "corner") + "; give at least three",
            "corners");
    for (std::size_t k = 0; k < corners_.size(); ++k) {
        checked_point(corners_[k], {"polygon", "corners", "corner " + std::to_string(k + 1)});
        if (corners_[k] == corners_[(k + 1) % corners_.size()])
            throw ToolError("polygon: corner " + std::to_string(k + 1) + " is repeated", "corners");
    }
}

Patch Polygon::on(const Tool& tool) const {
    const Plane& plane = plane_for(tool, "polygon");
    const std::size_t count = corners_.size();
    double size = 0;
    for (const Vector3d& c : corners_) size = std::max(size, (c - corners_[0]).norm());
    std::vector<Vector3d> at;
    for (std::size_t k = 0; k < count; ++k)
        at.push_back(on_plane(plane, corners_[k], size, "corner " + std::to_string(k + 1) + " of the polygon"));
    const FlatPolygon flat(plane, at);
    refuse_crossing_sides(flat.corners);
    const double area = signed_area(flat.corners);
    if (std::abs(area) <= 1e-9 * size * size) throw ToolError("polygon: its area is zero", "within");
    Patch patch;
    patch.feature_size = half_width(flat.corners);
    for (std::size_t k = 0; k < count; ++k) {
        const Vector3d along = (at[(k + 1) % count] - at[k]).normalized();
        patch.sides.push_back(std::make_unique<Plane>(at[k], (area > 0 ? 1 : -1) * along.cross(plane.unit_normal())));
        patch.corners.push_back({at[k], {static_cast<int>((k + count - 1) % count), static_cast<int>(k)}});
    }
    patch.distance = [flat](const Vector3d& x) { return flat.nearest(x).distance; };
    patch.side = [flat](const Vector3d& x) { return flat.nearest(x).side; };
    return patch;
}

CylinderPart::CylinderPart(double low, double high, std::optional<Angles> angles)
    : low_(low), high_(high), angles_(std::move(angles)) {
    if (!(std::isfinite(low) && std::isfinite(high) && low < high))
        throw ToolError(
            "cylinder part: along must go from one place to another farther along the axis, both finite numbers",
            "along");
    if (!angles_) return;
    checked_direction(angles_->zero, {"cylinder part", "zero"});
    if (!(angles_->start < angles_->end && angles_->end < angles_->start + 360))
        throw ToolError("cylinder part: the angles must go from start to a larger end, less than 360 degrees on",
                        "angles");
}

Patch CylinderPart::on(const Tool& tool) const {
    const auto* cylinder = dynamic_cast<const Cylinder*>(&tool);
    if (!cylinder)
        throw ToolError("within: a cylinder part lies on a cylinder, but the tool is a " + tool.kind(), "within");
    const Vector3d origin = cylinder->origin(), axis = cylinder->unit_axis();
    const double radius = cylinder->radius();
    Patch patch;
    patch.feature_size = (high_ - low_) / 2;
    if (angles_)
        patch.feature_size =
            std::min(patch.feature_size, radius * (angles_->end - angles_->start) * std::numbers::pi / 360);
    patch.sides.push_back(std::make_unique<Plane>(origin + low_ * axis, -axis));
    patch.sides.push_back(std::make_unique<Plane>(origin + high_ * axis, axis));
    const double middle = (low_ + high_) / 2, half = (high_ - low_) / 2;
    if (!angles_) {
        patch.distance = [=](const Vector3d& x) { return std::abs(axis.dot(x - origin) - middle) - half; };
        patch.side = [=](const Vector3d& x) { return axis.dot(x - origin) < middle ? 0 : 1; };
        return patch;
    }
    const Vector3d in = angles_->zero - axis.dot(angles_->zero) * axis;
    if (in.norm() < 1e-6 * angles_->zero.norm())
        throw ToolError("cylinder part: zero lies along the axis; give a direction across it", "within");
    const Vector3d u = in.normalized(), v = axis.cross(u);
    const double start = angles_->start * std::numbers::pi / 180, end = angles_->end * std::numbers::pi / 180,
                 centre = (start + end) / 2, spread = (end - start) / 2;
    const auto radial = [=](double t) { return Vector3d(std::cos(t) * u + std::sin(t) * v); };
    const auto tangent = [=](double t) { return Vector3d(-std::sin(t) * u + std::cos(t) * v); };
    patch.sides.push_back(std::make_unique<Plane>(origin, -tangent(start)));
    patch.sides.push_back(std::make_unique<Plane>(origin, tangent(end)));
    for (const int z : {0, 1})
        for (const int t : {2, 3})
            patch.corners.push_back(
                {origin + (z == 0 ? low_ : high_) * axis + radius * radial(t == 2 ? start : end), {z, t}});
    // Distances beyond the borders, along the axis and around it.
    const auto beyond = [=](const Vector3d& x, double& z, double& t, bool& upper, bool& later) {
        const double height = axis.dot(x - origin) - middle;
        const double turn =
            std::remainder(std::atan2(v.dot(x - origin), u.dot(x - origin)) - centre, 2 * std::numbers::pi);
        upper = height > 0;
        later = turn > 0;
        z = std::abs(height) - half;
        t = radius * (std::abs(turn) - spread);
    };
    patch.distance = [=](const Vector3d& x) {
        double z, t;
        bool upper, later;
        beyond(x, z, t, upper, later);
        return z > 0 && t > 0 ? std::hypot(z, t) : std::max(z, t);
    };
    patch.side = [=](const Vector3d& x) {
        double z, t;
        bool upper, later;
        beyond(x, z, t, upper, later);
        return z > t ? (upper ? 1 : 0) : (later ? 3 : 2);
    };
    return patch;
}

}  // namespace femscalpel
