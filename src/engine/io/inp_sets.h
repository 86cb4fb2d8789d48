// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/solver_sets.h"
#include "io/inp_places.h"

namespace femscalpel {

/// A set that a deck gets anew.
struct NewSet {
    DeckSetType type;
    std::string name;
    std::vector<Index> members;  ///< as in SetMembers
    std::string remark;          ///< a comment line before it, or empty
};

/// How the sets of a deck come to have the members that the groups of a mesh have. To be moved, not copied: `roles`
/// look into `members`.
struct DeckSetPlan {
    DeckSetPlan() = default;
    DeckSetPlan(DeckSetPlan&&) = default;
    DeckSetPlan& operator=(DeckSetPlan&&) = default;

    std::vector<std::vector<Index>> members;          ///< per set of the deck: what it must have, as in SetMembers
    std::vector<SetRole> roles;                       ///< per set: left to its cards, listed anew, or dropped
    std::vector<char> has_own_card;                   ///< per set: it has a *NSET, *ELSET or *SURFACE card
    std::vector<NewSet> new_sets;                     ///< by type
    std::vector<std::vector<Index>> members_of_card;  ///< per card: numbers of what stands under it
    std::vector<std::vector<Index>> contributed;      ///< per card: what its NSET= or ELSET= adds
    std::vector<char> drops_parameter;                ///< per card: its NSET= or ELSET= would be untrue
    std::vector<char> planes;                         ///< plane_families() of the mesh
};

/// Makes the plan. `index`: of the sets of `input`. Throws WriteError for groups that cannot be sets (see write_inp()),
/// and where elements outside the mesh contradict it.
DeckSetPlan plan_sets(const Mesh& mesh, const SolverInput& input, const NumberIndex& numbers, const DeckSetIndex& index,
                      const DeckPlaces& places);

/// The set a card belongs to, if any.
std::optional<std::size_t> set_index(const DeckSetIndex& index, const Card& card);

/// Lines "set, label" of an element surface all of whose faces are still on it; what they give is added to `given` and
/// taken out of `unheld`.
std::vector<std::string_view> lines_still_true(const SolverInput& input, const DeckSetIndex& index,
                                               const DeckSetPlan& plan, const NumberIndex& numbers, std::size_t s,
                                               std::vector<Index>& given, std::vector<std::array<Index, 2>>& unheld);

/// Puts nodes of a set in the order in which its cards name them, which tells some of their users which are the first
/// (*MPC); new ones behind.
void put_in_order(const SolverInput& input, const DeckSetIndex& index, const DeckSetPlan& plan, std::size_t set,
                  std::vector<Index>& nodes);

}  // namespace femscalpel
