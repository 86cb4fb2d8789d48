// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deformation/relaxation.h"

namespace femscalpel {

/// Second-order elements whose curved_ratio() is below this are not made, unless they were worse before.
inline constexpr double curved_limit = 0.15;

/// Where the mid-side node of an edge belongs.
struct MidSide {
    Vec3 at;
    bool fits;  ///< false: there is no point near the chord on the surface, curve and tools the edge is on
};

/// The tools the edge a-b lies on. Where a curved skin touches a tool, an edge can have both ends on it without being part of
/// the interface; it stays with the skin.
Contact edge_tools(const Deformable& d, int a, int b);

/// Mid-side node of an edge of the band with its ends where they are: it keeps its place relative to the chord, and on a
/// curved surface or curve of the input, or on tools, it lies on them.
MidSide mid_side(const Deformable& d, int a, int b);

/// Smallest curved_ratio() of the elements around a node, were it at `x`; 1 if they are straight, -1 if a mid-side node
/// does not fit. Moves the node there and back.
double curved_around(Deformable& d, int node, const Vec3& x);

/// curved_ratio() of a tetrahedron of the band as it is.
double curved_shape(const Deformable& d, int tetra);

/// Whether second-order elements around a node stay sound when it moves to `x`.
bool keeps_curved_shape(Deformable& d, int node, const Vec3& x);

/// Smallest curved_ratio() of the elements around the edge a-b when it is split at `at`.
double curved_children(const Deformable& d, int a, int b, const Vec3& at, const Contact& tools);

/// Smallest curved_ratio() of the elements around node p when it is merged into its neighbour t.
double curved_merged(const Deformable& d, int p, int t);

}  // namespace femscalpel
