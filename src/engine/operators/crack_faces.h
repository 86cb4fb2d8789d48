// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"
#include "tools/tool.h"

namespace femscalpel {

/// Cracks `mesh` along faces that it has: those that the group `faces` covers (part_along()). Elements may be of any
/// type; none moves, none is split. Of the options, `name` and `strict` count.
///
/// New groups: NAME_P and NAME_N, the lips; NAME_FRONT, segments along the edges where the crack ends inside a solid,
/// in shells the nodes at its tips. Throws ToolError (bad name, no such group, nothing to part) and what carry_deck()
/// does.
Result crack_along_faces(const Mesh& mesh, const std::string& faces, const OperatorOptions& options,
                         const Prepared& prepared = {});

/// The same along the faces that lie on a tool which passes through no element: then quadrangles and hexahedra need not
/// become triangles and tetrahedra. Nothing where it does, or the mesh has none of these, or is to be refined; nor
/// where shells end on the tool beside the solids, shells could not follow (Parted::bridges), or double nodes are near.
std::optional<Result> crack_between_elements(const Mesh& mesh, const Tool& tool, const OperatorOptions& options,
                                             const Prepared& prepared = {});

}  // namespace femscalpel
