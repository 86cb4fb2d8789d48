// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <string>

namespace femscalpel {

/// What is checked: which parameter of which tool.
struct ToolParameter {
    const char* tool;           ///< such as "cylinder"; "" for a parameter of an operator
    const char* name;           ///< of the parameter, such as "axis"; a literal, see Error
    std::string called = name;  ///< in the message, where that is not the name

    /// Such as "cylinder: axis".
    std::string text() const { return *tool ? std::string(tool) + ": " + called : called; }
};

// Checks of a tool's parameters. The ToolError names the parameter and says what is wrong with it.

/// `x`, if all its values are finite.
Eigen::Vector3d checked_point(const Eigen::Vector3d& x, const ToolParameter& parameter);

/// `v` scaled to unit length, if it has a direction.
Eigen::Vector3d checked_direction(const Eigen::Vector3d& v, const ToolParameter& parameter);

/// `length`, if it is finite and positive.
double checked_length(double length, const ToolParameter& parameter);

}  // namespace femscalpel
