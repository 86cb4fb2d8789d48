// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "deformation/deformable.h"

namespace femscalpel {

/// The deformation engine (paper, 3.1.2; resources/docs/architecture.md, "relax"): brings the rest of a band in line
/// with interface nodes that have already been put in place. First the bar network spreads the displacements of
/// `interface` over `transition`, node by node where that does not spoil elements; then relax() improves the shape of
/// all elements, interface nodes sliding on their tool.
void deform(Deformable& d, const std::vector<int>& interface, const std::vector<int>& transition);

}  // namespace femscalpel
