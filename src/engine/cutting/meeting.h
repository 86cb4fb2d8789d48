// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/surface.h"

namespace femscalpel {

/// A line in which the surfaces of two meshes meet: one smooth piece, between corners and junctions.
struct MeetingLine {
    /// A point of it.
    struct Point {
        Vec3 at;
        std::array<Vec3, 2> normal;  ///< unit normals of the two surfaces there, turned alike along the line
        std::array<Index, 2> node;   ///< the node of each mesh that lies there, or -1
    };
    std::vector<Point> points;
    bool closed = false;  ///< then the last point is joined to the first
};

/// Where the surfaces of two meshes meet, crossing each other, or with the border or a feature line of one on the other;
/// what is nearer than `tolerance` touches. Where they lie on each other over an area, it is the outline of that.
/// Pieces of less than three tolerances are left out.
///
/// Faces are intersected pair by pair (Möller, "A fast triangle-triangle intersection test", J. Graphics Tools 2,
/// 1997), vertices within the tolerance of the other's plane lying in it.
std::vector<MeetingLine> find_meeting(const Mesh& a, const Mesh& b, double tolerance);

}  // namespace femscalpel
