// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "cutting/workpiece.h"
#include "deformation/curved_shape.h"

namespace femscalpel {

// Second-order elements of the input whose Jacobian is not positive, or nearly so, at a corner, though it is at the
// points where solvers integrate: common in real meshes, and accepted by solvers. Where an operator changes such an
// element, it cannot be left as it is: parts of it would be folded at their own integration points. So its mid-side
// nodes are moved before anything else is done, and put back afterwards where nothing needed it. The same with elements
// that are not folded, but worse than operators make any.

/// Notes them in `workpiece` (those below curved_limit), or throws QualityError naming the elements that are folded at
/// an integration point.
void find_folded_input(Workpiece& workpiece, const Mesh& mesh);

/// Moves mid-side nodes that are free to move towards the middle of their edges, on the surfaces and curves they lie
/// on, until those elements are sound; no element around gets worse. Some may remain folded.
void mend_folded_input(Workpiece& workpiece);

/// Puts those mid-side nodes back that no changed element needs, and adds a warning that names the elements. To be
/// called last, when contacts are what they will be.
void put_back_middles(Workpiece& workpiece, const Mesh& mesh);

/// Of these elements, those that are not parts of elements that were folded in the input, or are worse than these were
/// or folded at an integration point.
std::vector<BandElement> newly_folded(const Workpiece& workpiece, std::vector<BandElement> elements);

/// Throws QualityError naming the elements of the input when some of these are parts of ones that were folded and could
/// not be mended.
void check_folded_input(const Workpiece& workpiece, std::span<const BandElement> elements);

}  // namespace femscalpel
