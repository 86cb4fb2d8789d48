// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "operators/report.h"

namespace femscalpel {

/// Node groups that were those of faces are so afterwards, where an operator made the skin anew. One that had exactly
/// the nodes of an element group of triangles has these again; of others, all of whose nodes were on the skin of the
/// solid, nodes that are inside now leave. `skin`: that of the mesh before. The counts in the report follow.
void keep_face_nodes(const Mesh& before, const std::vector<std::array<Index, 3>>& skin, Result& result);

}  // namespace femscalpel
