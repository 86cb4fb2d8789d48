// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/beams.h"
#include "cutting/simplify.h"

namespace femscalpel {

/// Divides beams where tools pass through them: nodes there, and in the middle of second-order beams, whose mid-side
/// node becomes one between two, are ends of their parts, which have the old beam's shape. The first part keeps the
/// beam's number and place; it and the others, numbered from `numbering` on, are in all its groups. New nodes are in
/// the node groups that both ends are in and that go along the beam: over its middle node, on to a further beam, or
/// through all beams; two supports at its ends are none between them. `mesh` may have marks.
Simplified split_beams(const Mesh& mesh, const BeamCuts& cuts, const Numbering& numbering);

}  // namespace femscalpel
