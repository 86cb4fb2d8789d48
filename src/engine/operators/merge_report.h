// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "operators/report.h"

namespace femscalpel {

/// Records of the groups of `input` and of what was added to it; of groups that `known`, of the last step alone, has,
/// what it says of moved nodes and borders is kept.
std::vector<GroupRecord> merged_records(const Mesh& input, const Mesh& result, const std::vector<GroupRecord>& known);

/// Puts the quality of what was joined into a report, before and after: of the elements of the mesh that were changed,
/// and of all of the addition, which are the element group `added` of the result; but for the mesh's triangles where
/// there are tetrahedra, whose skin they are.
void describe_joined(const Mesh& input, const Mesh& addition, const Mesh& result, const std::string& added,
                     Report& report);

/// Nodes that elements of the group `name` and others have, mid-side nodes, too; ascending.
std::vector<Index> shared_nodes(const Mesh& mesh, const std::string& name);

/// Makes a node group NAME_SEAM of nodes.
void add_seam(Mesh& mesh, const std::string& name, const std::vector<Index>& nodes);

/// Of warnings about how the seam runs by surfaces and borders, which come from each of its lines and each time it was
/// worked on, keeps the worst of each kind; of others that say the same, one.
void join_warnings_about_the_seam(std::vector<std::string>& warnings);

/// The report on two operations on a mesh, one after the other, by those on each.
Report joined(const Report& before, Report after);

}  // namespace femscalpel
