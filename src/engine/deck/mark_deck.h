// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "deck/surface_sets.h"
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
    /// Nodes (as `pinned`) that cards relate to others (BoundNodes): not to be the tips of pyramids; of them, those
    /// that are not to be at the base of one, if they are mid-side nodes.
    std::vector<Index> no_tips, no_bases;
    std::vector<Index> pinned;  ///< nodes (indices, ascending) that must not move: a force, a term of an equation
    /// Of `pinned`, those that may after all move, each with others, as all that they are in are equations with nodes
    /// at the same place.
    std::map<Index, std::vector<Index>> together;
};

/// First letters of the names of all hidden groups of mark_deck().
inline constexpr std::string_view mark_prefix = "*MARK#";

/// Prepares a mesh read from a CalculiX deck for an operator; linear in deck and mesh. The rules of the cards
/// (rules/) say what has to be kept:
///
/// - Nodes of supports, and elements and element faces under distributed loads, that cards name by number (faces
///   also by set and label): those with one value on one card form a hidden group, to be kept like one of the
///   user's. So the loaded area, and with it the load, stays the same, and shows where the load is afterwards.
/// - Element sets that exist only for surfaces are found: they constrain nothing, and follow the surfaces.
/// - Nodes with concentrated loads and terms of equations by number, reference nodes, and nodes of elements
///   outside the mesh are pinned.
/// - Nodes that may be dependent are found.
DeckMarks mark_deck(const Mesh& mesh);

/// Takes the hidden groups of mark_deck() out of a mesh.
void remove_marks(Mesh& mesh);

}  // namespace femscalpel
