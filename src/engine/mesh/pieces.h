// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Elements of dimension 1 or more that share nodes, directly or through others, and nothing with the rest.
struct Piece {
    int dimension = 0;               ///< largest of its elements
    double measure = 0;              ///< length, area or volume of those of the largest dimension
    Vec3 place{0, 0, 0};             ///< their centre: of corners, weighted by measure
    std::vector<Index> elements;     ///< numbers, ascending
    std::vector<Index> nodes;        ///< numbers, ascending
    std::vector<GroupIndex> groups;  ///< that have nodes, elements or facets of it, ascending; no hidden ones
};

/// The pieces of a mesh by dimension, then measure, the largest first. Nodes without elements, or with point elements
/// alone, are in none. Nodes at one place are not one node, and what a solver's input ties together besides
/// (equations, contact) does not count. Nearly linear time.
std::vector<Piece> find_pieces(const Mesh& mesh);

/// Those of `mesh` after a change: the nodes and elements of `changed` take the place of those of the same number, and
/// elements numbered `gone` count no more. Groups are those of `mesh`; of what `changed` has, by name and kind.
std::vector<Piece> find_pieces(const Mesh& mesh, const Mesh& changed, std::span<const Index> gone);

}  // namespace femscalpel
