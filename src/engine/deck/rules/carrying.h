// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "deck/card_edits.h"
#include "deck/deck_view.h"
#include "deck/node_origins.h"
#include "deck/rules/closed_sets.h"
#include "deck/rules/emptied_sets.h"
#include "deck/rules/remarks.h"
#include "mesh/changes.h"

namespace femscalpel {

/// A change of a mesh as the rules see it: the deck as it was, what became of nodes and elements (by number), and where
/// edits and remarks go.
class Carrying {
public:
    /// Arguments as of carry_deck(); all must outlive this. Takes new nodes out of closed sets of `after`.
    Carrying(const Mesh& before, Mesh& after, const Changes& changes);

    const Mesh& before() const { return before_; }
    const Mesh& after() const { return after_; }
    const Changes& changes() const { return changes_; }
    /// The deck and the mesh as they were.
    const DeckView& old() const { return old_; }
    const NumberIndex& new_numbers() const { return new_numbers_; }
    const NodeOrigins& origins() const { return origins_; }

    CardEdits& edits(std::size_t card) { return edits_[card]; }
    Remarks& remarks() { return remarks_; }
    ClosedSets& closed_sets() { return closed_sets_; }
    const EmptiedSets& emptied_sets() const { return emptied_sets_; }

    /// The input had the node, the result has not.
    bool node_gone(Index number) const { return old_.numbers().node(number) && !new_numbers_.node(number); }
    /// The node moved so far that it counts.
    bool node_moved(Index number) const;
    /// The input had the element.
    bool had_element(Index number) const { return old_.numbers().cell(number).has_value(); }
    /// All elements that an element of the input became, itself first.
    std::vector<Index> parts_of(Index element) const;
    bool has_further_parts(Index element) const { return parts_.contains(element); }
    /// The element of the input that an element of the result is or is a part of.
    Index origin_of(Index element) const;
    /// Whether an element of the result is plane or axisymmetric.
    bool is_plane_now(Index element) const;
    /// What type an element of the result is of.
    CellType type_now(Index element) const { return new_numbers_.cell(element)->type; }

    /// The deck with all edits; that of `before` itself if there are none.
    std::shared_ptr<const Companion> result();

private:
    const Mesh& before_;
    Mesh& after_;
    const Changes& changes_;
    DeckView old_;
    NumberIndex new_numbers_;
    NodeOrigins origins_;
    SolverInput input_;  // the new deck
    std::vector<CardEdits> edits_;
    Remarks remarks_;
    ClosedSets closed_sets_;
    EmptiedSets emptied_sets_;
    std::unordered_map<Index, std::vector<Index>> parts_;  // parent -> further parts
    std::unordered_map<Index, Index> parents_;             // further part -> parent
    double size_ = 0;
};

}  // namespace femscalpel
