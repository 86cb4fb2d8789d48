// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Elements of dimension 1 or more that share nodes, directly or through others.
struct Piece {
    int dimension = 0;        ///< largest of its elements
    Index elements = 0;       ///< how many, of all dimensions but 0
    double measure = 0;       ///< length, area or volume of those of the largest dimension
    Vec3 place{0, 0, 0};      ///< their centre: of corners, weighted by measure
    std::vector<int> groups;  ///< that have nodes, elements or facets of it, ascending; no hidden ones
};

/// What a mesh falls into.
struct Pieces {
    std::vector<Piece> list;   ///< by dimension, then measure, the largest first
    std::vector<int> of_node;  ///< index into `list`; -1 for nodes of no element, or of point elements alone
};

/// The pieces of a mesh. Nodes at one place are not one node, and what a solver's input ties together besides
/// (equations, contact) does not count.
Pieces find_pieces(const Mesh& mesh);

}  // namespace femscalpel
