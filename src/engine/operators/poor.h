// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"
#include "operators/report.h"

namespace femscalpel {

/// Nodes that count as on the tool though something holds them a little beside it (Deformable::hold_beside()); with a
/// warning in the interface that names what does.
HeldNodes find_held_nodes(Workpiece& workpiece, const Mesh& mesh);

/// No poor result in silence: finds the elements that came out worse than a mean ratio of 0.02, and than a tenth of the
/// `worst_before` of the input's near the tool. Where kept surfaces, lines or nodes and the tool leave no room for
/// better ones they are returned, one entry for each combination of what holds them, worst first, with a warning in the
/// interface that says what would help.
///
/// Throws QualityError naming the place when nothing holds an element that is so poor.
std::vector<PoorPlace> find_poor_places(Workpiece& workpiece, const Mesh& mesh, double worst_before);

}  // namespace femscalpel
