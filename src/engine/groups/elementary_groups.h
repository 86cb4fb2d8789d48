// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Entities that belong to exactly the same groups (paper, 2.2 and Figure 3.g; a family in MED).
struct ElementaryGroup {
    GroupKind kind = GroupKind::node;
    int dimension = 0;               ///< of the entities: 0 for nodes, 0 to 3 for elements; of a facet 1 or 2
    std::vector<GroupIndex> groups;  ///< ascending; never empty, never hidden ones
    GroupMembers members;            ///< in mesh order
};

/// The disjoint classes that the overlapping groups of `mesh` fall into: for nodes, for elements of each
/// dimension, for facets. Every entity of a visible group is in exactly one of them, the others in none.
/// Hidden groups do not tell classes apart.
///
/// Ordered by kind, dimension, then groups. Linear in the mesh plus the total length of the classes' group
/// lists.
std::vector<ElementaryGroup> elementary_groups(const Mesh& mesh);

}  // namespace femscalpel
