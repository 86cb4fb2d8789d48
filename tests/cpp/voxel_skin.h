// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <vector>

#include "cutting/cavity.h"

namespace femscalpel::checks {

/// A closed surface.
struct VoxelSkin {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;  ///< normals point outwards
};

/// The skin of the cubes of side 1 among nx x ny x nz from the origin for which `is_there` holds, two triangles a face.
VoxelSkin voxel_skin(int nx, int ny, int nz, const std::function<bool(int, int, int)>& is_there);

}  // namespace femscalpel::checks
