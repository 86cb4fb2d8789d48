// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "cutting/opening.h"

namespace femscalpel {

/// Appends the groups of an opening to a mesh, in order, each name once: `groups[k]` names those of what has
/// Opening::Face::group k. They are element groups, but for those that only ends of beams are for: node groups. Returns
/// their indices, as `groups`.
std::vector<std::vector<GroupIndex>> add_opening_groups(Mesh& mesh, const Opening& opening,
                                                        const std::vector<std::vector<std::string>>& groups);

}  // namespace femscalpel
