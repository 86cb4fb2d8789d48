// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include "mesh/mesh.h"

namespace femscalpel {

/// How far coordinates may be off what they were before a file rounded them, in the mesh's unit: half a unit of their
/// last digit where many of them end after some 5 to 11 significant digits (text files), or half a unit in the last
/// place of single precision where they are numbers of that; 0 for coordinates that show neither (double precision),
/// and for those that are simple, such as a grid's. At most 1e-5 of the size of the mesh. New nodes in double precision
/// among old rounded ones, as a second operation meets them, do not hide these. Looks at some thousand coordinates.
double coordinate_rounding(std::span<const Vec3> points);

/// Nodes that are no farther apart are at one place, where coordinates are `rounding` off.
double same_place(std::span<const Vec3> points, double rounding);

}  // namespace femscalpel
