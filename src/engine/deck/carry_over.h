// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "deck/rules/joined_remarks.h"
#include "deck/rules/remarks.h"
#include "mesh/changes.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// Makes the deck of `after` say the same as that of `before`. `before` is what the operator worked on,
/// `changes` what it did; `after` still has the hidden groups of mark_deck(). Sets and surfaces follow the
/// groups and need nothing. The rules of the cards (rules/) say what becomes of them:
///
/// - *CLOAD, *CFLUX, *DISTRIBUTING COUPLING, *RETAINED NODAL DOFS: a node named by number keeps its load whole; of a
///   doubled node that is the original, on the crack's negative side. Where a set has new members the card
///   names a new set of the old ones, NAME_LOAD1, which stays as it is under further operators.
/// - *DLOAD, *DFLUX, *FILM, *RADIATE, *MASS FLOW, *BOUNDARYF: loads on a face, by element number or set, go to all
///   pieces of the face; other loads on a numbered element to all its parts.
/// - *BOUNDARY, *TEMPERATURE, *INITIAL CONDITIONS, *NODAL THICKNESS, *SUBMODEL: copies of a node have what the node
///   has; a node born on an edge has it if both ends have. Values that differ from node to node are
///   interpolated in the old elements at the new node's place, also for nodes that moved.
/// - *EQUATION: nodes born between nodes that have equations are related to those born between their partners, copies
/// to copies
///   (related_nodes.h); where there is none, terms stay on the originals, and that is told. *NETWORK MPC: terms stay on
///   the originals. Sets with new members are replaced as for *CLOAD. An equation with a removed node is left out:
///   there is nothing any more that it would hold.
/// - *MPC: PLANE and STRAIGHT get new nodes between their nodes, and lose removed ones; other types stay on the
/// originals, and
///   it is told where nodes are born between these.
/// - *NORMAL, *DISTRIBUTION, *MODEL CHANGE: parts of an element get what the element has.
/// - Initial stresses, plastic strains and solution: integration points of its parts get what the nearest one had.
/// - Reference nodes, nodes of elements outside the mesh stay the originals.
///
/// - Results of the mesh as it was, read by number (foreign_results.h), and numbers that nobody has and of which
/// CalculiX says nothing any more, are told.
///
/// What of this changes the meaning, what names something removed or a set that lost all its members, and cards of
/// unknown keyword, are remarks "file:line: ...", to be told. Throws Error when a node of an element outside the mesh
/// is removed. Nothing happens without a deck.
Remarks carry_deck(const Mesh& before, Mesh& after, const Changes& changes);

/// Remarks as warnings. With `strict`, problems, which is all but what is said about whole concentrated loads, make an
/// Error that lists them.
std::vector<std::string> warnings_of(const Remarks& remarks, bool strict);

/// The same of two changes one after the other.
std::vector<std::string> warnings_of(const JoinedRemarks& remarks, bool strict);

}  // namespace femscalpel
