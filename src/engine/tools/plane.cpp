// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/plane.h"

#include <limits>

#include "error.h"

namespace femscalpel {

Plane::Plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal) : origin_(origin), normal_(normal) {
    if (!origin.allFinite()) throw ToolError("plane: origin has a value that is not a finite number");
    if (!normal.allFinite()) throw ToolError("plane: normal has a value that is not a finite number");
    const double length = normal.stableNorm();
    if (!(length > 0)) throw ToolError("plane: normal is the zero vector; give a direction");
    normal_ = normal / length;
}

double Plane::feature_size() const { return std::numeric_limits<double>::infinity(); }

}  // namespace femscalpel
