// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "fracture/auxiliary_field.h"
#include "fracture/crack_lips.h"

namespace femscalpel {

/// Stress intensity in modes 1, 2 and 3 at places of a front by how far the lips have come apart behind it,
/// extrapolated to the front (Chan, Tuba and Wilson, Eng. Fract. Mech. 2 (1970)); NaN where there are too few pairs of
/// nodes within `radius` of it and `along` along it.
std::vector<std::array<double, 3>> lip_displacements(const Mesh& mesh, std::span<const Vec3> displacements,
                                                     const CrackLips& lips, const CrackFront& front,
                                                     const std::vector<double>& places, double radius, double along,
                                                     const Elasticity& elasticity);

}  // namespace femscalpel
