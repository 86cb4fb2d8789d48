// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>

#include "deformation/kept_geometry.h"

namespace femscalpel {

/// The closest point to some point of a surface or curve.
struct Foot {
    Vec3 at = Vec3::Zero();
    Vec3 normal = Vec3::Zero();  ///< unit normal of a surface; tangent of a curve
    double distance2 = 0;        ///< square of the distance
    double inside = 0;           ///< smallest barycentric coordinate on a facet
    int piece = -1;              ///< the facet or segment it is on
};

/// The closest point of one facet or segment, without `piece`. On a second-order facet, `distance2` is infinite and the
/// rest undefined if that is surely not less than `limit2`.
Foot foot_on(const KeptGeometry::Facet& facet, const Vec3& x, double limit2 = std::numeric_limits<double>::infinity());
/// The same of a segment.
Foot foot_on(const KeptGeometry::Segment& segment, const Vec3& x);

/// The point closest to `x` of the surface or curve that a node with this constraint (surface or curve) stays on. A
/// plane or a straight line goes on without end; else it is sought from facet to facet (segment to segment), from
/// `c.hint` on, as long as a neighbour is nearer: the closest point nearby. Where that lies on the shape the mesh was
/// made from, it is the closest point of that.
Foot surface_foot(const KeptGeometry& geometry, const NodeConstraint& c, const Vec3& x);
/// The same on a curve.
Foot curve_foot(const KeptGeometry& geometry, const NodeConstraint& c, const Vec3& x);

}  // namespace femscalpel
