// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/sphere.h"

#include "tools/checks.h"

namespace femscalpel {

Sphere::Sphere(const Eigen::Vector3d& center, double radius)
    : center_(checked_point(center, {"sphere", "center"})), radius_(checked_length(radius, {"sphere", "radius"})) {}

Eigen::Vector3d Sphere::normal(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d r = x - center_;
    const double length = r.norm();
    if (!(length > 1e-300)) return Eigen::Vector3d::UnitZ();
    return r / length;
}

}  // namespace femscalpel
