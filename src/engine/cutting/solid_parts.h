// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "cutting/quad_cuts.h"
#include "mesh/shape_blend.h"

namespace femscalpel {

/// A tetrahedron or pyramid that a solid is cut into: its corners, the tip last; -1 stands for a new node inside.
struct SolidPart {
    std::array<Index, 5> corners{};
    int count = 4;
};

/// How a solid is cut into tetrahedra, and pyramids on quadrangular faces that are to stay.
struct SolidParts {
    std::vector<SolidPart> parts;
    Blend centre;            ///< place of the new node inside; empty if there is none
    Index centre_node = -1;  ///< or the node that is there already
    /// Edges of the parts that need a mid-side node, and its place; an end of -1 is the new node inside.
    std::vector<std::pair<std::array<Index, 2>, Blend>> middles;
    /// Smallest mean ratio of the parts, for curved ones times the ratio of their smallest Jacobian to that of the
    /// straight ones; not positive if one is inverted.
    double quality = -1;
};

/// Cuts a solid: all parts have one tip. That is one of its corners, where the diagonals of the faces at it allow that
/// and the parts are about as good, else a new node in its middle, or where it makes the parts better.
SolidParts cut_solid(const Mesh& mesh, const CellRef& cell, const Conversion& conversion, QuadCuts& cuts);

}  // namespace femscalpel
