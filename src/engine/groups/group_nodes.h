// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// By node of the mesh, whether it is a member of the group, or of an element or facet of it. (Of facets the corners.)
std::vector<char> nodes_of_group(const Mesh& mesh, GroupIndex group);

}  // namespace femscalpel
