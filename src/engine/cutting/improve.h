// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"

namespace femscalpel {

/// Works on elements that relaxation alone leaves worse than `goal`, by changing what the operator
/// itself made: merges a node born on a split edge into a neighbour on the same surfaces, and bisects
/// long edges where the tool passes close to a corner or crease, each time relaxing around the place.
/// Nodes of the input are never removed, element and group borders never moved.
///
/// Follows the schedule of Freitag and Ollivier-Gooch, "Tetrahedral mesh improvement using swapping and
/// smoothing", Int. J. Numer. Meth. Engng. 40 (1997): a change is kept only if the worst element around
/// it gets better.
void improve(Workpiece& workpiece, double goal);

/// Collects the node sets, then improves the shape of the band's elements: deform(), improve(), and new nodes brought
/// onto their curved surfaces.
void relax_band(Workpiece& workpiece);

}  // namespace femscalpel
