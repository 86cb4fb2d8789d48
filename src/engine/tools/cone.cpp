// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/cone.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "error.h"
#include "tools/axis_frame.h"
#include "tools/checks.h"

namespace femscalpel {
namespace {

double checked_angle(double degrees) {
    if (degrees > 0 && degrees < 90) return degrees;
    std::ostringstream message;
    message << "cone: half_angle is " << degrees << "; it must lie between 0 and 90 degrees";
    throw ToolError(message.str(), "half_angle");
}

}  // namespace

Cone::Cone(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double radius, double half_angle)
    : origin_(checked_point(origin, {"cone", "origin"})),
      axis_(checked_direction(axis, {"cone", "axis"})),
      radius_(checked_length(radius, {"cone", "radius"})),
      half_angle_(checked_angle(half_angle)),
      sine_(std::sin(half_angle * std::numbers::pi / 180)),
      cosine_(std::cos(half_angle * std::numbers::pi / 180)),
      apex_(origin_ - radius_ * cosine_ / sine_ * axis_) {}

double Cone::distance(const Eigen::Vector3d& x) const {
    const AxisFrame at(x, apex_, axis_);
    if (at.height * cosine_ + at.radius * sine_ < 0) return (x - apex_).norm();  // the apex is the closest point
    return at.radius * cosine_ - at.height * sine_;
}

Eigen::Vector3d Cone::normal(const Eigen::Vector3d& x) const {
    const AxisFrame at(x, apex_, axis_);
    if (at.height * cosine_ + at.radius * sine_ < 0) return (x - apex_).normalized();
    return cosine_ * at.outward - sine_ * axis_;
}

double Cone::feature_size() const { return radius_ / cosine_; }

}  // namespace femscalpel
