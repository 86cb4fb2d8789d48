// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <span>

#include "mesh/mesh.h"
#include "tools/tool.h"

namespace femscalpel {

/// What lies between a wall and a cone or torus that it is to be moved onto, a part `share` (0 to 1) of the way: where
/// the wall's nodes lie on a cone or cylinder, or on a torus, about the same axis, one of these. Null where they do not
/// (to within `tolerance`), or the target is another surface.
std::unique_ptr<Tool> revolved_between(std::span<const Vec3> wall, const Tool& target, double share, double tolerance);

}  // namespace femscalpel
