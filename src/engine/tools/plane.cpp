// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/plane.h"

#include <limits>

#include "tools/checks.h"

namespace femscalpel {

Plane::Plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal)
    : origin_(checked_point(origin, {"plane", "origin"})), normal_(checked_direction(normal, {"plane", "normal"})) {}

double Plane::feature_size() const { return std::numeric_limits<double>::infinity(); }

}  // namespace femscalpel
