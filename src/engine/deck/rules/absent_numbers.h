// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// Numbers of nodes and elements that cards name and nobody has. CalculiX refuses a deck with such a number above the
/// largest in use, and passes over it below. Whoever got it later would have loads and supports that nobody gave it, so
/// nothing new does (Companion::largest_other_node()). The rules of the cards find them (CardRule::list_numbers());
/// those in sets are not among them, as a set is listed anew once it would have other members (DeckSet::absent).
class AbsentNumbers {
public:
    /// What one card names, of one kind.
    struct OfCard {
        std::size_t card = 0;
        bool node = true;            ///< of nodes; else of elements
        std::string where;           ///< the line of the first, "deck.inp:12: "
        std::vector<Index> numbers;  ///< as often as it is named, in the order of the card
    };

    /// Looks through all cards of `input`, as a deck of `mesh`; linear in both.
    AbsentNumbers(const Mesh& mesh, const SolverInput& input);

    /// By card.
    const std::vector<OfCard>& all() const { return all_; }
    /// The largest number of a node, 0 without any.
    Index largest_node() const { return largest(true); }
    /// The same of elements.
    Index largest_element() const { return largest(false); }

    /// For the rules: a line of the card names a node; nothing where there is one, or none can have that number.
    void name_node(const CardReader& line, Index number) { name(true, line, number); }
    /// The same of an element.
    void name_element(const CardReader& line, Index number) { name(false, line, number); }
    /// The first entry of each line is a node's number, or something else that is passed over.
    void name_nodes_first(const Card& card);
    /// The same of elements.
    void name_elements_first(const Card& card);
    /// All cards of the deck.
    const std::vector<Card>& cards() const { return input_.cards(); }

private:
    void name(bool node, const CardReader& line, Index number);
    Index largest(bool node) const;

    const SolverInput& input_;
    NumberIndex numbers_;
    std::vector<Index> others_;  // elements beside the mesh, ascending
    std::size_t card_ = 0;
    std::vector<OfCard> all_;
};

/// "*BOUNDARY names node 90 and 1 more", for messages behind OfCard::where.
std::string named_text(const AbsentNumbers::OfCard& named, const Card& card);

/// Warns of them, one line for each card and kind of numbers, and keeps new nodes and elements of `mesh`, whose deck
/// `input` is to be, from them.
void warn_of_absent_numbers(const Mesh& mesh, SolverInput& input);

}  // namespace femscalpel
