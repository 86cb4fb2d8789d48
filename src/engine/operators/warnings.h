// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "cutting/workpiece.h"
#include "groups/group_report.h"
#include "operators/report.h"

namespace femscalpel {

/// Angles and gaps at which geometry alone, not the method, limits the quality near the tool. Only where elements have
/// become worse.
void warn_of_grazing(Workpiece& f, const Tool& tool, const Mesh& mesh);

/// Surfaces that lie on each other, such as the lips of a crack that the mesh had already, are worked on each for
/// itself: their nodes may part.
void warn_of_parted_lips(Workpiece& f);

/// Beyond what tools take, and drifting borders hand over, only the corners between the facets of a curved skin can get
/// lost, when their nodes move: warns where that is much of the mesh or of a group. (With the shape of the skin given,
/// what changes is the error of the facets: this is not for that.) `whole` is the mesh before, of which `totals` are;
/// `before` may be its band alone. Groups that are `unjudged`, by index, are not looked at; none if empty.
void warn_of_changed_size(const Mesh& whole, const Mesh& before, const FamilyTotals& totals, const FamilyTotals& after,
                          const Workpiece& f, const std::vector<bool>& unjudged, Report& report);

/// That a group lost all its members.
std::string emptied_text(const GroupRecord& record);

/// Groups that lost all their members, as the records say; but for element groups that follow surfaces, the
/// `meaningless` ones.
void warn_of_emptied_groups(const Mesh& before, const std::vector<bool>& meaningless, Report& report);

/// Throws ToolError when a mesh of `cells` elements has become many times larger by a crack, hole or cut; a warning for
/// small ones, and other operations.
void check_growth(Index cells, const Tool& tool, Report& report);

/// Groups that are scattered through the material hold nodes everywhere: warns where these are many and the elements
/// came out poor.
void warn_of_held_nodes(const Workpiece& f, const Mesh& before, Report& report);

}  // namespace femscalpel
