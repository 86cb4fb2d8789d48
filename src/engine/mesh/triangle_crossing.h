// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>

#include "mesh/mesh.h"

namespace femscalpel {

/// The ends of a segment.
using Span = std::array<Vec3, 2>;
/// The corners of a triangle.
using TriangleCorners = std::array<Vec3, 3>;

/// The segment in which two triangles cross; nothing where they meet in less, or nearly lie in one plane. Vertices no
/// farther than the tolerance from the other's plane lie in it, and such a vertex is an end of the segment as it is
/// (Möller, "A fast triangle-triangle intersection test", J. Graphics Tools 2, 1997).
std::optional<Span> cross_triangles(const TriangleCorners& a, const TriangleCorners& b, double tolerance);

}  // namespace femscalpel
