// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <random>
#include <set>
#include <vector>

#include "mesh/mesh.h"

/// Random meshes and groups, and what covers what by the definition in virtual_boundary.h, worked out the slow way.
namespace femscalpel::checks {

using Nodes = std::set<Index>;  ///< of an edge, a face, an element

void add_cells(Mesh& mesh, CellType type, const std::vector<std::vector<Index>>& cells);

/// A box of n^3 bricks (dimension 3, six tetrahedra each) or n^2 squares, thinned out at random, with faces,
/// edges and nodes of it as elements at random; `attached` scales how many. The box is sheared at random.
Mesh random_mesh(std::mt19937& rng, int dimension, int n, double attached = 1);

/// Members near a random point with a probability, so that areas, faces and lone ones all occur.
void add_random_groups(std::mt19937& rng, Mesh& mesh, int count);

struct Expected {
    std::set<Nodes> area, bounding, linking_faces, linking_edges;
    Nodes isolated;
};

/// All subsets of `size` nodes.
std::set<Nodes> subsets(const Nodes& nodes, std::size_t size);

bool contains(const Nodes& all, const Nodes& part);

/// The definition in virtual_boundary.h, by trying everything; linear simplices only.
Expected slow_boundary(const Mesh& mesh, GroupIndex group);

}  // namespace femscalpel::checks
