// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/coordinate_slack.h"

#include <algorithm>

#include "mesh/rounding.h"

namespace femscalpel {
namespace {

/// Directions of what is hardly longer than it may be off say nothing; so faces across are still told apart.
constexpr double most = 0.5;

}  // namespace

// In the direction of a normal, the roundings of three coordinates add up to sqrt(3) times one.
CoordinateSlack::CoordinateSlack(const Mesh& mesh) : off_(2 * coordinate_rounding(mesh.points)) {}

double CoordinateSlack::direction(double length) const {
    return off_ == 0 ? 0 : std::min(most, 2 * off_ / std::max(length, off_));
}

double CoordinateSlack::normal(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return off_ == 0 || longest == 0 ? 0 : direction((b - a).cross(c - a).norm() / longest);
}

}  // namespace femscalpel
