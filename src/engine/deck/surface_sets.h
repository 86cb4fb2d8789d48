// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// An element set that a deck has only for its *SURFACE lines to name faces of its elements: "_TOP_S1" of the line
/// "_TOP_S1, S1". What it encloses means nothing, and so does its border; it has to be the elements with that face on
/// the surface.
struct SurfaceSet {
    GroupIndex group = 0;  ///< the element group that holds the set
    std::vector<std::pair<GroupIndex, int>>
        faces;  ///< by surface line: the surface's facet group, and the label 1 to 6
};

/// The sets of a mesh's deck that element surfaces name with a face, and that nothing else of the deck uses: no other
/// line, no parameter of a card, no *ELEMENT card. Linear in the deck. None without a deck.
std::vector<SurfaceSet> surface_sets(const Mesh& mesh);

/// By group index of `mesh`: whether the group is one of `sets`. Empty if there are none.
std::vector<bool> groups_of(std::span<const SurfaceSet> sets, const Mesh& mesh);

/// Makes `sets` follow their surfaces in what an operator made: of the elements `changed`, which have inherited the
/// sets of their parents, each is then in those sets whose label its face on the surface has now. An element whose
/// surface has no set for that label is in none, and has to be named by the surface itself. `input` is the deck of the
/// mesh that was changed.
void renew_surface_sets(Mesh& mesh, std::span<const SurfaceSet> sets, const SolverInput& input,
                        std::span<const CellRef> changed);

}  // namespace femscalpel
