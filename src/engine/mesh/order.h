// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "mesh/mesh.h"

namespace femscalpel {

/// Whether the elements of the mesh's dimension have mid-side nodes; false if only some have.
bool is_second_order(const Mesh& mesh);

/// The mesh with mid-side nodes in the middle of all edges that had none. New nodes are numbered above those in use;
/// they are in the node groups of both ends. Elements with more nodes than those on edges stay.
Mesh to_second_order(const Mesh& mesh);

/// The mesh with the corners of its elements alone. Nodes that only second-order elements had go, also out of groups.
Mesh to_first_order(const Mesh& mesh);

}  // namespace femscalpel
