// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// An edge that has to stay straight, by node numbers.
struct TiedEdge {
    Index middle = 0;  ///< its mid-side node
    Index a = 0, b = 0;
};

/// Edges at the bases of pyramids of second order, where a tetrahedron or prism of second order is on that side; in the
/// order of the nodes in the mesh.
std::vector<TiedEdge> edges_of_pyramids(const Mesh& mesh);

/// Edges that solids of second order have in common with elements of first order. Of lines and faces those count that
/// the solver has as elements of their own. None if the mesh's deck does not say that such edges are tied
/// (SolverInput::ties_orders()).
std::vector<TiedEdge> edges_between_orders(const Mesh& mesh);

}  // namespace femscalpel
