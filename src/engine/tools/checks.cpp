// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/checks.h"

#include <cmath>
#include <sstream>

#include "error.h"

namespace femscalpel {

Eigen::Vector3d checked_point(const Eigen::Vector3d& x, const std::string& what) {
    if (!x.allFinite()) throw ToolError(what + " has a value that is not a finite number");
    return x;
}

Eigen::Vector3d checked_direction(const Eigen::Vector3d& v, const std::string& what) {
    const double length = checked_point(v, what).stableNorm();
    if (!(length > 0)) throw ToolError(what + " is the zero vector; give a direction");
    return v / length;
}

double checked_length(double length, const std::string& what) {
    if (!std::isfinite(length)) throw ToolError(what + " is not a finite number");
    if (!(length > 0)) {
        std::ostringstream message;
        message << what << " is " << length << "; it must be positive";
        throw ToolError(message.str());
    }
    return length;
}

}  // namespace femscalpel
