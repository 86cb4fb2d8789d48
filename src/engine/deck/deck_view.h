// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "deck/solver_sets.h"

namespace femscalpel {

/// A mesh with its deck, to look up what lines name.
class DeckView {
public:
    /// `mesh` must have a deck.
    explicit DeckView(const Mesh& mesh);

    const Mesh& mesh() const { return mesh_; }
    const SolverInput& input() const { return input_; }
    const std::vector<Card>& cards() const { return input().cards(); }
    const NumberIndex& numbers() const { return numbers_; }

    /// Number of the step a card is in, from 1; 0 in the model definition.
    int step(std::size_t card) const { return steps_[card]; }

    /// The group that holds a node or element set, if the deck defines it and the mesh still has it.
    std::optional<GroupIndex> group(DeckSetType type, std::string_view name) const;
    bool has_node(GroupIndex group, Index node) const {
        return mesh_.families.contains(mesh_.node_families[node], group);
    }
    /// Numbers of a group's nodes or elements; kept for further calls.
    const std::vector<Index>& members(GroupIndex group) const;

    /// Whether an element is plane or axisymmetric, which counts in the labels of its faces.
    bool is_plane(CellRef cell) const { return planes_[mesh_.block(cell.type).families[cell.cell]] != 0; }

private:
    const Mesh& mesh_;
    const SolverInput& input_;
    NumberIndex numbers_;
    DeckSetIndex sets_;
    std::vector<int> steps_;
    std::vector<char> planes_;
    mutable std::unordered_map<GroupIndex, std::vector<Index>> members_;
};

/// The first entry of a data line, a number or a set's name.
struct NumberOrSet {
    Index number = 0;  ///< if `set` is empty
    std::string set;
    bool is_number() const { return set.empty(); }
};

/// Reads the next field of the line; none if it is empty.
std::optional<NumberOrSet> read_number_or_set(CardReader& line);

/// Goes to the next data line whose first entry is not empty, and reads that; none at the end of the card.
std::optional<NumberOrSet> next_entry(CardReader& line);

/// Reads all that is left of the line; empty entries are left out.
std::vector<NumberOrSet> read_entries(CardReader& line);

/// TYPE= of a card, in upper case without blanks; empty without.
std::string type_of(const Card& card);

/// What a card says beside its lines, but for OP=: lines under equal cards of one step add up.
std::string parameters_key(const Card& card);

}  // namespace femscalpel
