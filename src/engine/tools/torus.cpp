// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/torus.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "error.h"
#include "tools/axis_frame.h"
#include "tools/checks.h"

namespace femscalpel {

Torus::Torus(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double major_radius, double minor_radius)
    : center_(checked_point(center, {"torus", "center"})),
      axis_(checked_direction(axis, {"torus", "axis"})),
      major_(checked_length(major_radius, {"torus", "major_radius"})),
      minor_(checked_length(minor_radius, {"torus", "minor_radius"})) {
    if (minor_ < major_) return;
    std::ostringstream message;
    message << "torus: minor_radius is " << minor_ << "; it must be smaller than major_radius, " << major_
            << ", or the torus crosses itself";
    throw ToolError(message.str(), "minor_radius");
}

double Torus::distance(const Eigen::Vector3d& x) const {
    const AxisFrame at(x, center_, axis_);
    return std::hypot(at.radius - major_, at.height) - minor_;
}

Eigen::Vector3d Torus::normal(const Eigen::Vector3d& x) const {
    const AxisFrame at(x, center_, axis_);
    const double across = at.radius - major_, length = std::hypot(across, at.height);
    if (!(length > 1e-300)) return at.outward;
    return (across * at.outward + at.height * axis_) / length;
}

double Torus::feature_size() const { return std::min(minor_, major_ - minor_); }

}  // namespace femscalpel
