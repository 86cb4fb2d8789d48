// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/checks.h"

#include <cmath>
#include <sstream>

#include "error.h"

namespace femscalpel {

Eigen::Vector3d checked_point(const Eigen::Vector3d& x, const ToolParameter& parameter) {
    if (!x.allFinite()) throw ToolError(parameter.text() + " has a value that is not a finite number", parameter.name);
    return x;
}

Eigen::Vector3d checked_direction(const Eigen::Vector3d& v, const ToolParameter& parameter) {
    const double length = checked_point(v, parameter).stableNorm();
    if (!(length > 0)) throw ToolError(parameter.text() + " is the zero vector; give a direction", parameter.name);
    return v / length;
}

double checked_length(double length, const ToolParameter& parameter) {
    if (!std::isfinite(length)) throw ToolError(parameter.text() + " is not a finite number", parameter.name);
    if (!(length > 0)) {
        std::ostringstream message;
        message << parameter.text() << " is " << length << "; it must be positive";
        throw ToolError(message.str(), parameter.name);
    }
    return length;
}

}  // namespace femscalpel
