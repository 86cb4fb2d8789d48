// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <set>

#include "mesh/crop.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// Borders of groups that run through elements which are taken out, where no others with such a border take their
/// place.
struct CrossedBorders {
    std::set<GroupIndex> groups;  ///< of elements on but one side of such a border
    std::set<GroupIndex> faces;   ///< that lose faces which lay between the elements
    Index lost = 0;               ///< these faces
    Vec3 at = Vec3::Zero();       ///< the middle of one of the borders' faces
};

/// Those of the `taken` tetrahedra of a mesh (ascending lists by type), where they are outside of another solid: what
/// is inside is cut off. `is_kept`: whether a face, by its nodes in ascending order, is one of elements again. Hidden
/// groups do not count.
CrossedBorders crossed_borders(const Mesh& mesh, const CellLists& taken, const Mesh& other,
                               const std::function<bool(const std::array<Index, 3>&)>& is_kept);

}  // namespace femscalpel
