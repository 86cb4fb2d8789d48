// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Whether the elements of the mesh's dimension have mid-side nodes; false if only some have.
bool is_second_order(const Mesh& mesh);

/// The mesh with mid-side nodes in the middle of all edges that had none. New nodes are numbered above those in use;
/// they are in the node groups of both ends. An edge whose ends are one node has that one. Elements with more nodes
/// than those on edges stay.
Mesh to_second_order(const Mesh& mesh);

/// Elements of first order that get mid-side nodes.
struct RaisedOrder {
    Mesh mesh;
    std::vector<CellRef> before, after;      ///< these elements (indices in the input, in `mesh`)
    std::vector<std::array<Index, 3>> made;  ///< new nodes and the ends of their edges, by number
};

/// The same for the elements with chosen[type][cell] alone, new nodes numbered from `number` on.
RaisedOrder to_second_order(const Mesh& mesh, const std::array<std::vector<char>, cell_type_count>& chosen,
                            Index number);

/// The mesh with the corners of its elements alone. Nodes that only second-order elements had go, also out of groups.
Mesh to_first_order(const Mesh& mesh);

}  // namespace femscalpel
