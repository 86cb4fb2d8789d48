// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "operators/report.h"

namespace femscalpel {

/// Records of the groups of `input` and of what was added to it; of groups that `known` has, what that says of the
/// mesh alone is kept.
std::vector<GroupRecord> merged_records(const Mesh& input, const Mesh& result, const std::vector<GroupRecord>& known);

/// Makes a node group NAME_SEAM of nodes.
void add_seam(Mesh& mesh, const std::string& name, const std::vector<Index>& nodes);

}  // namespace femscalpel
