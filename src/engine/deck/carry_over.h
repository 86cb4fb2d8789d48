// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/surface_sets.h"
#include "mesh/changes.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// What an operator has to respect so that the cards of a deck can follow it. See mark_deck().
struct DeckMarks {
    /// A copy of the mesh with hidden groups for what cards name by number; none if there is no such card.
    /// The operator works on this copy in place of its input.
    std::optional<Mesh> mesh;
    std::vector<bool> kept;  ///< by group index of `mesh`: a hidden group whose boundary must keep its shape
    std::vector<SurfaceSet> surface_sets;  ///< element groups whose boundary means nothing, see renew_surface_sets()
    std::vector<Index> related;  ///< of them, those related by equations: nodes born between two of them on the skin
                                 ///< must not move either
    std::vector<Index> pinned;   ///< nodes (indices, ascending) that must not move: a force, a term of an equation
};

/// Prepares a mesh read from a CalculiX deck for an operator; linear in deck and mesh.
///
/// - Nodes of supports, and elements and element faces under distributed loads, that cards name by number (faces
///   also by set and label): those with one value on one card form a hidden group, to be kept like one of the
///   user's. So the loaded area, and with it the load, stays the same, and shows where the load is afterwards.
/// - Element sets that exist only for surfaces are found: they constrain nothing, and follow the surfaces.
/// - Nodes with concentrated loads and terms of equations by number, reference nodes, and nodes of elements
///   outside the mesh are pinned.
DeckMarks mark_deck(const Mesh& mesh);

/// Makes the deck of `after` say the same as that of `before`. `before` is what the operator worked on,
/// `changes` what it did; `after` still has the hidden groups of mark_deck(). Sets and surfaces follow the
/// groups and need nothing:
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
/// - *NORMAL, *DISTRIBUTION, *MODEL CHANGE, initial stresses, plastic strains and solution: parts of an element get
///   what the element has.
/// - Reference nodes, nodes of elements outside the mesh stay the originals.
///
/// What of this changes the meaning, what names something removed or a set that lost all its members, and cards of
/// unknown keyword, are warnings "file:line: ..."; with `strict` all of them but the ones about whole concentrated
/// loads make an Error, and `after` is then of no use. So does, always, a removed node of an element outside the mesh.
void carry_deck(const Mesh& before, Mesh& after, const Changes& changes, bool strict,
                std::vector<std::string>& warnings);

/// Takes the hidden groups of mark_deck() out of a mesh.
void remove_marks(Mesh& mesh);

}  // namespace femscalpel
