// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mesh/mesh.h"

namespace femscalpel {

/// How far what follows from coordinates may be off because a file rounded these: within that, a line is straight and a
/// face plane. Nothing for coordinates that were not rounded.
class CoordinateSlack {
public:
    /// `off`: how far a node may be off where it belongs.
    explicit CoordinateSlack(double off) : off_(off) {}
    /// By coordinate_rounding() of the mesh.
    explicit CoordinateSlack(const Mesh& mesh);

    /// A node: a length.
    double off() const { return off_; }
    /// The direction from one node to another at this distance, in radians: at most half a radian.
    double direction(double length) const;
    /// The normal of the triangle of three nodes, in radians: the more, the nearer one is to the side across. At most
    /// half a radian.
    double normal(const Vec3& a, const Vec3& b, const Vec3& c) const;

private:
    double off_;
};

}  // namespace femscalpel
