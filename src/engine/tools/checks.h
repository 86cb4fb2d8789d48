// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <string>

namespace femscalpel {

// Checks of a tool's parameters. `what` names the tool and the parameter, e.g. "cylinder: axis"; the ToolError says
// what is wrong with it.

/// `x`, if all its values are finite.
Eigen::Vector3d checked_point(const Eigen::Vector3d& x, const std::string& what);

/// `v` scaled to unit length, if it has a direction.
Eigen::Vector3d checked_direction(const Eigen::Vector3d& v, const std::string& what);

/// `length`, if it is finite and positive.
double checked_length(double length, const std::string& what);

}  // namespace femscalpel
