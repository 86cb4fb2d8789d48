// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "mesh/adjacency.h"

namespace femscalpel {

/// A part of a mesh, as a mesh of its own.
struct Crop {
    Mesh mesh;                 ///< numbers, coordinates, families, groups (also those left empty) as in the whole
    std::vector<Index> nodes;  ///< index in the whole mesh of each node, ascending
};

/// The elements `cells` of a mesh, with their nodes and facets. The order of nodes and
/// elements is kept; the solver's input is not taken along. Apart from the families, the cost is that of the part and
/// one look at each node.
Crop crop(const Mesh& mesh, const CellLists& cells);

/// The elements of `after` that are new against `before`, by number, or have a node that is new or has moved.
Mesh changed_part(const Mesh& before, const Mesh& after);

}  // namespace femscalpel
