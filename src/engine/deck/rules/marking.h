// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deck/deck_view.h"
#include "deck/mark_deck.h"

namespace femscalpel {

/// Collects what rules mark in a deck. Names of groups are those after mark_prefix; what has one name is one group.
class Marking {
public:
    /// `mesh` must have a deck, and outlive this.
    explicit Marking(const Mesh& mesh) : deck_(mesh) {}

    const DeckView& deck() const { return deck_; }

    /// The node of this number, if the mesh has it, must not move.
    void pin(Index number);
    /// Nor must this one, and nodes born on the skin between two such neither.
    void pin_related(Index number);
    /// Whether both are in the mesh, as double nodes.
    bool is_one_place(Index number, Index other);
    /// The same as pin_related() for two that are to stay at one place, unless they move together.
    void pin_pair(Index number, Index other);
    /// Group `group` of nodes must keep its shape, and node `number`, if the mesh has it, is in it.
    void mark_node(const std::string& group, Index number);
    /// The same for elements.
    void mark_element(const std::string& group, Index number);
    /// The same for element faces.
    void mark_face(const std::string& group, Index element, int face);

    /// All that was marked.
    DeckMarks result();

private:
    std::set<Index> with_ends_of_middles(std::set<Index> pinned) const;
    Mesh marked(std::vector<bool>& kept) const;
    void mark_facets(Mesh& mesh) const;

    DeckView deck_;
    std::set<Index> pinned_, related_;
    double same_place_ = -1;                     // as far as double nodes are apart, once it is known
    std::map<Index, std::vector<Index>> pairs_;  // by node: those it is to stay with
    // By name of the group to be.
    std::map<std::string, std::vector<Index>> nodes_;
    std::map<std::string, std::vector<CellRef>> cells_;
    std::map<std::string, std::vector<std::pair<CellRef, int>>> faces_;
};

}  // namespace femscalpel
