// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "mesh/mesh.h"

namespace femscalpel {

/// The element that covers a facet, for formats that have no facets.
struct FacetElement {
    CellType type = CellType::triangle;
    int size = 0;                  ///< number of nodes
    std::array<Index, 9> nodes{};  ///< indices in the mesh, the first `size` of them
};

/// The face or edge element on a facet of a mesh, with the mid-side and centre nodes the facet's own element has there.
/// Its normal points out of a volume element, or, for the sides of a shell, away from the shell on that side.
FacetElement facet_element(const Mesh& mesh, const Facet& facet);

}  // namespace femscalpel
