// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "cutting/workpiece.h"

namespace femscalpel {

/// Runs `cut`, which has to leave `workpiece` relaxed, and looks at what came out: where new nodes could not be brought
/// onto the skin or line they were born on and their tools, or second-order elements came out folded, it starts again
/// with other choices there: nodes not put on the tool, then elements refined before the cut; `attempts` times at most,
/// and within bounds on the band's growth, also against the mesh's `mesh_elements`, and on the work of all tries. Poor
/// elements are a reason, too: first to hold nodes beside the tool that it passes closely, then, but for a whole plane
/// through flat surfaces (`whole_tool`), to refine.
///
/// Throws QualityError naming the place when nothing helps.
void cut_soundly(Workpiece& workpiece, const std::function<void(Workpiece&)>& cut, Index mesh_elements,
                 int attempts = 12, bool whole_tool = false);

}  // namespace femscalpel
