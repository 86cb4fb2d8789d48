// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/deck_view.h"
#include "mesh/changes.h"

namespace femscalpel {

/// Node sets that must not grow, as each node in them has its own load: in place of a set with new members a card names
/// a new set of the old ones, NAME_LOAD1, which stays as it is under further operators (DeckSet::closed).
class ClosedSets {
public:
    /// Takes new nodes out of the closed sets that `after` has already. `input` is the deck to be of `after`; all must
    /// outlive this.
    ClosedSets(const DeckView& old, Mesh& after, const NumberIndex& new_numbers, const Changes& changes,
               SolverInput& input);

    /// The name that stands for a set's old members: its own if it has no new ones, else that of a closed set, which is
    /// made when first asked for.
    std::string name_of_old_members(const std::string& name);
    /// How many members of a node set were removed.
    Index lost_members(std::string_view name) const;
    /// The group of `after` that holds a node set.
    std::optional<GroupIndex> group_now(std::string_view name) const;

    /// Closed sets were made.
    bool any() const { return !closed_.empty(); }
    /// Puts cards for the sets that were made after the last card of the mesh.
    void define();

private:
    bool has_new_members(GroupIndex group) const;
    std::string closed_set(const std::string& name, GroupIndex group);

    const DeckView& old_;
    Mesh& after_;
    const NumberIndex& new_numbers_;
    SolverInput& input_;
    DeckSetIndex sets_;
    std::vector<Index> new_nodes_;
    std::map<std::string, std::string> closed_;  // set -> set of its old members
};

}  // namespace femscalpel
