// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"
#include "simple_meshes.h"
#include "tools/plane.h"

namespace femscalpel::checks {

/// A workpiece with the whole mesh in its band, in which all nodes may move; nodes on the tool are in contact with it,
/// nothing is cut. `tool` has to live as long.
Workpiece whole_workpiece(const Mesh& mesh, const Tool& tool);

/// The band node there.
int node_at(const BandMesh& band, const Vec3& at);

/// A tool far from everything.
inline const Plane away({100, 0, 0}, {1, 0, 0});

/// A cube of eight, away from any tool, and its middle node. Bars end there along the axes (6), the diagonals of faces
/// (6) and of cubes (2); the elements around it are symmetric about it.
struct CubeOfEight {
    Mesh mesh = grid(2, 2, 2);
    Deformable d = whole_workpiece(mesh, away).d;
    int middle = node_at(d.band, {1, 1, 1});
};

}  // namespace femscalpel::checks
