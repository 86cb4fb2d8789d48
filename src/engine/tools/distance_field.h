// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <vector>

#include "tools/tool.h"

namespace femscalpel {

/// Distance from a point to what a mesh is refined around, in the mesh's unit. May be signed: an edge whose ends
/// have different signs is at distance 0, unless both are so far off that the surface cannot be between them.
using DistanceField = std::function<double(const Eigen::Vector3d&)>;

/// Distance to the nearest of some tools, which must outlive the field. Throws ToolError when there is none.
DistanceField distance_to(std::vector<const Tool*> tools);

/// Distance to the nearest of some points. Throws ToolError when there is none or one is not finite.
DistanceField distance_to(std::vector<Eigen::Vector3d> points);

}  // namespace femscalpel
