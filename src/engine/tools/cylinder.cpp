// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/cylinder.h"

#include <Eigen/Geometry>

#include "tools/checks.h"

namespace femscalpel {

Cylinder::Cylinder(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double radius)
    : origin_(checked_point(origin, {"cylinder", "origin"})),
      axis_(checked_direction(axis, {"cylinder", "axis"})),
      radius_(checked_length(radius, {"cylinder", "radius"})) {}

Eigen::Vector3d Cylinder::from_axis(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d r = x - origin_;
    return r - axis_.dot(r) * axis_;
}

double Cylinder::distance(const Eigen::Vector3d& x) const { return from_axis(x).norm() - radius_; }

Eigen::Vector3d Cylinder::normal(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d r = from_axis(x);
    const double length = r.norm();
    if (!(length > 1e-300)) return axis_.unitOrthogonal();
    return r / length;
}

}  // namespace femscalpel
