// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// A triangle of a mesh's surface, by corners.
struct SurfaceFace {
    std::array<Index, 3> nodes;  ///< of a solid's skin: normal outwards
    bool shell;                  ///< an element of its own, not the face of a solid
};

/// Nodes of a triangular face, ascending: its name, whichever element it is looked at from.
using FaceKey = std::array<Index, 3>;
/// The same corners, ascending.
FaceKey face_key(FaceKey face);

/// The faces of a mesh's surface that reach into a box: faces that only one solid has, and shells that are no face of a
/// solid; a quadrangle is two. One pass over the elements. outer_faces() also says whose they are.
std::vector<SurfaceFace> surface_near(const Mesh& mesh, const Eigen::AlignedBox3d& box);

/// A box made larger on all sides.
Eigen::AlignedBox3d grown(Eigen::AlignedBox3d box, double by);

/// The box around all nodes of a mesh that elements have.
Eigen::AlignedBox3d box_around(const Mesh& mesh);

}  // namespace femscalpel
