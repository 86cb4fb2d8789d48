// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "mesh/crop.h"
#include "operators/joint.h"

namespace femscalpel {

/// What of a shell that was joined to another (the second mesh of a Joint) is on a point's side of that: of its pieces
/// between the lines those that leave most of their lines towards the side on which the point is there. Pieces that no
/// line bounds stay. Throws ToolError (parameter keep_side) when nothing is left.
Crop trimmed(const Mesh& addition, std::span<const JointLine> lines, const Vec3& point);

}  // namespace femscalpel
