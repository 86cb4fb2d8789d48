// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>

#include "mesh/band_mesh.h"

namespace femscalpel {

/// Where the rim of a wall (cut faces; of shells cut edges) would slide off what it slides on: a surface or line that
/// is kept beside the wall, which it is moved into, and past the other end of. `goal`: where nodes of the wall go;
/// what is within `off` edge lengths of the surface or line is on it. Beyond where these end at the wall, they go on.
std::optional<Vec3> slides_off(const BandMesh& band, const std::function<Vec3(int)>& goal, double off);

}  // namespace femscalpel
