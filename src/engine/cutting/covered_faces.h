// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "mesh/surface.h"

namespace femscalpel {

/// The faces of a solid's skin that another solid covers: those on its skin, no farther off than `tolerance`, or inside
/// of it. What is covered must be bounded by edges of `outline` (pairs of nodes): faces joined by other edges are
/// covered together or not at all, by where most of their area is.
std::vector<SurfaceFace> covered_faces(const Mesh& mesh, const Mesh& other,
                                       const std::vector<std::array<Index, 2>>& outline, double tolerance);

}  // namespace femscalpel
