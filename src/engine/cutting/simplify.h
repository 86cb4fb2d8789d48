// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "cutting/conversion.h"
#include "cutting/rebuild.h"
#include "mesh/changes.h"

namespace femscalpel {

/// A mesh some of whose elements were divided: into simplices, or beams into beams.
struct Simplified {
    Mesh mesh;
    std::vector<CellRef> before;                     ///< those elements (indices in the input)
    std::vector<CellRef> after;                      ///< what they became (indices in `mesh`)
    std::array<Index, cell_type_count> converted{};  ///< how many, by their type
    Index pyramids = 0;                              ///< that stand on faces of elements that stayed
    Index nodes_added = 0;
    Index nodes_removed = 0;     ///< in the middle of elements or faces, that nothing needs any more
    std::vector<Index> stops;    ///< numbers of the nodes in which beams were divided
    Index beams_cut = 0;         ///< places where a tool passes through a beam
    std::vector<CellRef> unfit;  ///< elements in which pyramids came out poor (indices in the input)
    Changes changes;             ///< where new nodes and elements come from, by number
};

/// Makes simplices of elements, of the order they have: triangles of quadrangles, cut along the diagonal that is better
/// (QuadCuts); tetrahedra of solids (cut_solid()), and pyramids on the faces `bases`. Degenerate elements are what
/// they are: a hexahedron with a face in one point is cut as the pyramid that it is. Triangles of seven nodes lose the
/// one in their middle.
///
/// Mid-side nodes, and nodes in the middle of quadrangles that are cut, stay where they are; new ones lie in the old
/// element's shape. A part keeps the element's number; it and the others, numbered from `numbering` on, are in all its
/// groups. Facets go to all parts that have a piece of the face. A new node is in the node groups that all corners of
/// its face or element are in.
///
/// Throws UnsupportedElementError that names an element when its parts are poor (a mean ratio below 0.02, and below a
/// tenth of its own), unless pyramids are among them and `unfit` is to tell.
Simplified simplify(const Mesh& mesh, const Conversion& conversion, const Numbering& numbering,
                    bool tell_unfit = false);

}  // namespace femscalpel
