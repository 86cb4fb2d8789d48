// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "deformation/deformable.h"

namespace femscalpel {

/// Displacements that spread those of some nodes over others (paper, 3.1.2): every edge of an element is a
/// bar of null initial length whose stiffness is one over its length, and the network's energy is least.
/// `known` nodes have the displacements `given`; `unknown` nodes move within their constraints'
/// tangent space; all others stay. One sparse, positive definite system, solved by conjugate gradients.
/// Returns one displacement per unknown node.
std::vector<Vec3> bar_network_displacements(const Deformable& d, const std::vector<int>& known,
                                            const std::vector<Vec3>& given, const std::vector<int>& unknown);

}  // namespace femscalpel
