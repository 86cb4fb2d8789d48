// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// Puts a deck of parts and instances (Abaqus/CAE) together to the flat one that CalculiX reads: nothing where it has
/// no *INSTANCE card.
///
/// Each instance gets, in its place, the cards of its part and then its own. Of what changes:
/// - Numbers: an instance keeps its part's, unless one before it has some of them; then a round number is added to all
///   of them, of nodes and of elements (DeckInstance::offset). The assembly's own (reference points) come last.
/// - Names of sets, surfaces, orientations, ties stay where they are used once; else those of instances become
///   INSTANCE_NAME.
/// - Coordinates: *SYSTEM and cylindrical coordinates are worked out, then the instance's translation, then its
///   rotation. Directions turn with it: *ORIENTATION, *TRANSFORM, *NORMAL, *DISTRIBUTION, *GAP, beams' first axes.
/// - References: INSTANCE.NUMBER, INSTANCE.NAME and INSTANCE= in the assembly, the model and the steps; a REF NODE that
///   is a set of one node is this node.
/// - Materials in a part stand once. Parts without an instance go, which is a warning.
/// *PART, *ASSEMBLY, *INSTANCE and their ends go, their comments stay. Lines of the flat deck are told by their place
/// in the user's files.
///
/// Fills `input`'s instances and warnings and puts a note at the head of its cards that says how instances are
/// numbered. Throws ReadError "file:line: ..." for what take_parts_apart(), FlatNames and FlatCards refuse.
void flatten_parts(SolverInput& input);

}  // namespace femscalpel
