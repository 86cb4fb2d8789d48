// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Numbers of the nodes and elements of every group of a mesh, by group, in the order of the mesh; in one pass over it,
/// as writers of text files need them.
std::vector<std::vector<Index>> group_numbers(const Mesh& mesh);

}  // namespace femscalpel
