// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// The set a card defines or adds to: *NSET, *ELSET, *SURFACE, *NODE with NSET=, *ELEMENT with ELSET=.
/// Throws ReadError when a set card gives no name or a surface type CalculiX does not know.
std::optional<std::pair<DeckSetType, std::string>> set_of_card(const Card& card);

/// Finds sets by type and name as CalculiX compares names.
class DeckSetIndex {
public:
    explicit DeckSetIndex(std::span<const DeckSet> sets);
    std::optional<std::size_t> find(DeckSetType type, std::string_view name) const;

private:
    std::unordered_map<std::string, std::size_t> by_key_;
};

/// What the cards make of one set.
struct SetMembers {
    /// Ascending. Node or element numbers; for element surfaces 8 * element number + face label.
    std::vector<Index> members;
    std::vector<std::array<Index, 2>> unheld;  ///< ascending, see DeckSet::unheld
    Index absent = 0;                          ///< see DeckSet::absent
};

/// How a set takes part in an evaluation.
struct SetRole {
    enum { by_cards, replaced, dropped } state = by_cards;
    std::span<const Index> members;  ///< if replaced: what stands in place of its first card
};

/// Works out the members of all sets of `input` for the nodes and elements of `mesh`, in CalculiX's
/// order: *NODE, *ELEMENT, *NSET, *ELSET, *SURFACE, each kind in the order of the deck.
///
/// `contributed[c]` are the numbers that card c adds to the set in its NSET= or ELSET= parameter.
/// `roles` may be empty, then every set is as its cards say.
/// With `warnings`, throws ReadError naming file and line for what cannot be read, and reports numbers
/// nobody defined; without, such entries only count as absent.
std::vector<SetMembers> evaluate_sets(const Mesh& mesh, const NumberIndex& numbers, const SolverInput& input,
                                      std::span<const std::vector<Index>> contributed, std::span<const SetRole> roles,
                                      std::vector<std::string>* warnings);

/// Per card of `input`: for *NODE and *ELEMENT cards the numbers of the nodes or elements in its group,
/// in mesh order; nothing for other cards.
std::vector<std::vector<Index>> members_by_card(const Mesh& mesh, const SolverInput& input);

/// By family: its elements are under an *ELEMENT card of plane or axisymmetric type.
std::vector<char> plane_families(const Mesh& mesh, const SolverInput& input);

/// By family: TYPE= of the *ELEMENT card its elements are under; empty for families under none.
std::vector<std::string> labels_of_families(const Mesh& mesh, const SolverInput& input);

/// By family: its elements are under an *ELEMENT card of a type that cannot be divided (DeckElementType::whole). Empty
/// for meshes without a solver's input.
std::vector<char> families_of_whole_elements(const Mesh& mesh);

}  // namespace femscalpel
