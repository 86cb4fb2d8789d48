// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Where CalculiX integrates in a solid element (C3D4, C3D6, C3D8, C3D8R, C3D10, C3D15, C3D20, C3D20R and pyramids,
/// which are hexahedra there), in its order (ccx, gauss.f); between the corners alone, so not quite there in curved
/// elements. `nodes` are those of a `type` under an *ELEMENT card of `label`. None for types that are no such solids.
std::vector<Vec3> integration_points(std::string_view label, CellType type, std::span<const Vec3> nodes);

}  // namespace femscalpel
