// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// How unite() calls the groups of an addition that the mesh has, too.
struct UniteNames {
    std::string prefix;       ///< of those that do not join
    bool join_groups = true;  ///< groups of one name and kind are one
};

/// Adds the nodes and elements of `addition` to `mesh`, numbered above those in use; nodes with `shared[node] >= 0`
/// (index in `mesh`) are that node of the mesh, which joins their groups, as is the mid-side node of an edge between
/// two shared nodes that the mesh has one on. Groups of the addition keep their names; of one that the mesh has, see
/// `names`. Hidden groups are left out. All elements of the addition join the
/// element group `added`, which must exist.
///
/// Where both have a deck, the sections of the addition's, with materials and orientations, are taken over, too
/// (deck/adopt_sections.h).
///
/// Throws ToolError when a group of the addition, or a material, has no name left. Without `added` there is no such
/// group.
void unite(Mesh& mesh, const Mesh& addition, const std::vector<Index>& shared, const std::string& added,
           const UniteNames& names);

}  // namespace femscalpel
