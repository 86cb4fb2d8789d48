// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "mesh/mesh.h"

namespace femscalpel {

/// In what two second-order meshes were joined to, straightens edges inside the material that make elements worse than
/// curved_limit, where all elements around them are better for it: not those of the skin, of borders of groups, nor
/// those whose mid-side node is in a group.
///
/// Throws QualityError that names the place where an element stays folded at solvers' integration points and is none of
/// the two `inputs`.
void unfold(Mesh& joined, const std::array<const Mesh*, 2>& inputs);

}  // namespace femscalpel
