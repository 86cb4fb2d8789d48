// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "operators/report.h"

namespace femscalpel {

/// A sentence on where the two are, for errors.
std::string extents_text(const Mesh& mesh, const Mesh& addition);

/// Throws ToolError when a tolerance is no length, or so large that all of one of the two would count as touching.
void check_tolerance(const Mesh& mesh, const Mesh& addition, const std::optional<double>& tolerance);

/// Throws ToolError when faces of an addition pass through elements of it with which they have no node in common, or
/// triangles lie on each other. Sides of a contact or a crack, which but touch, may be there.
void check_itself(const Mesh& addition);

/// Throws ToolError when of an addition that was joined, the element group NAME_ADDED, some piece has none of the
/// nodes of NAME_SEAM: it would be held by nothing. Elements of dimension 0 are no pieces.
void check_pieces(const Mesh& result, const std::string& name);

/// Throws ToolError when one of two meshes that do not meet is inside the other.
void check_within(const Mesh& mesh, const Mesh& addition);

/// Warns of groups that have faces between the elements of the group `added` and others, which were on the skin.
void warn_of_buried(const Mesh& result, const std::string& added, Report& report);

/// Warns of groups of nodes and of facets that both meshes have, and that are one in the result: what a solver's input
/// does with the mesh's, it does with the addition's members, too.
void warn_of_joined_groups(const Mesh& mesh, const Mesh& addition, Report& report);

/// Warns that shells joined to a solid along their border turn about it.
void warn_of_hinge(Report& report);

/// Throws QualityError where edges between neighbours along the seams, as pairs of nodes of the result, are not edges
/// of both the elements of the group `added` and of others: the two would come apart there.
void check_seam_edges(const Mesh& result, const std::string& added, const std::vector<std::array<Index, 2>>& edges);

/// Warns of elements of the group `added`, shells joined to a solid, that are inside it.
void warn_of_inside(const Mesh& mesh, const Mesh& result, const std::string& added, Report& report);

/// Names of groups with members in the one mesh, and none in the other, where they are called the same.
std::vector<std::string> emptied_groups(const Mesh& before, const Mesh& after);

}  // namespace femscalpel
