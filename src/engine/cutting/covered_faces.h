// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "mesh/surface.h"

namespace femscalpel {

/// The faces of a solid's skin that another solid covers: those on its skin, no farther off than `tolerance`, or inside
/// of it. What is covered must be bounded by edges of `outline` (pairs of nodes): faces joined by other edges are
/// covered together or not at all, by where most of their area is. Where skins lie on each other and face the same way,
/// one of the two solids has the skin of both: the other, if `gives_way`.
std::vector<SurfaceFace> covered_faces(const Mesh& mesh, const Mesh& other,
                                       const std::vector<std::array<Index, 2>>& outline, double tolerance,
                                       bool gives_way);

}  // namespace femscalpel
