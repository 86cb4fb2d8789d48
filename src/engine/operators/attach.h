// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "operators/merge.h"

namespace femscalpel {

/// What merge() does with an addition of line elements: the nodes where its beams end on the mesh's surface become
/// nodes of that, moved there or split for, and are shared. That beams carry no moment where they end on solids is
/// warned of. `addition` is of the mesh's order.
///
/// Throws ToolError (parameter other) when no beam ends there, or one ends inside of a solid.
Result attach_beams(const Mesh& mesh, const Mesh& addition, const MergeOptions& options, const Prepared& known);

}  // namespace femscalpel
