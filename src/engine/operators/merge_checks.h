// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Throws ToolError (parameter "other") that says why two meshes whose surfaces nowhere meet do not: they are apart,
/// or one is inside the other.
[[noreturn]] void fail_apart(const Mesh& mesh, const Mesh& addition);

/// Throws ToolError (parameter "other") that names the place of a piece of the addition that none of the nodes `seam`,
/// ascending, joins to the rest. Pieces are elements of the group `added` that have nodes in common.
void check_pieces(const Mesh& mesh, const std::string& added, const std::vector<Index>& seam);

}  // namespace femscalpel
