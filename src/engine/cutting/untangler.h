// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "deformation/deformable.h"

namespace femscalpel {

/// Pulls elements that moving nodes turned over back into shape: each node in turn minimises the sum of
/// the squared inverse mean ratios around it, with the volume V replaced by (V + sqrt(V^2 + 4 delta^2)) / 2,
/// which is positive for every V, and delta lowered step by step. Escobar et al., "Simultaneous
/// untangling and smoothing of tetrahedral meshes", Comput. Methods Appl. Mech. Engng. 192 (2003).
///
/// Moves those of the nodes `movable` that are near elements worse than `goal` (a mean ratio), along their constraints,
/// until there are no such elements, or in vain a few times for each delta. Returns the worst mean ratio seen last: at
/// least `goal`, or, when that was not reached, that before the last sweep. Throws Cancelled.
double untangle(Deformable& d, const std::vector<int>& movable, double goal);

}  // namespace femscalpel
