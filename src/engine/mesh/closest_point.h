// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mesh/mesh.h"

namespace femscalpel {

/// The point of triangle a b c nearest to `p`; `bary` gets its barycentric coordinates (Ericson, Real-Time Collision
/// Detection, 5.1.5).
Vec3 closest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, Vec3& bary);

/// The point of segment a b nearest to `p`; a, if the segment has no length.
Vec3 closest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p);

}  // namespace femscalpel
