// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deck/deck_view.h"
#include "deck/related_nodes.h"
#include "deck/rules/card_rule.h"

namespace femscalpel {

/// *EQUATION and *NETWORK MPC: terms of node or set, degree of freedom, factor. Nodes of terms do not move. Of
/// *EQUATION, nodes born between nodes that have equations are related to those born between their partners, copies to
/// copies (related_nodes.h); where there is none, and of *NETWORK MPC, terms stay on the originals, and that is told.
/// Sets with new members are replaced by closed ones (closed_sets.h). An equation with a removed node is left out:
/// there is nothing any more that it would hold.
class Equations : public CardRule {
public:
    bool takes(const Card& card) const override;
    int names_per_line() const override { return 0; }
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void mark(std::size_t c, const Card& card, Marking& marking) override;
    void begin_carrying(Carrying& carrying) override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

private:
    /// An entry of a term as it is written.
    struct Entry {
        std::size_t line;                 ///< index into Equation::lines
        std::optional<NumberOrSet> what;  ///< of the first of a term, if it is not empty
        std::string text;
    };
    struct Equation {
        std::vector<CardReader> lines;       ///< the number of terms, and the lines that have them
        std::vector<Entry> entries;          ///< three for each term
        bool complete = false;               ///< all terms are there
        std::optional<std::size_t> related;  ///< index of the equation in related_, if it is of nodes by number
    };
    /// The equations of a card, up to what cannot be read as one.
    struct Read {
        std::vector<Equation> equations;
        std::optional<CardReader> unreadable;  ///< where that is
    };
    static Read read(const Card& card);
    static Equation read_terms(CardReader& line, Equation equation, Index terms);
    static std::optional<NodeEquation> of_nodes(const Equation& equation);
    static std::string line_text(const Equation& equation, std::size_t line);

    void relate(const std::vector<NodeEquation>& equations, Carrying& carrying);
    void tell_unrelated(const std::vector<RelatedNodes::Missed>& missed, const std::string& what, Carrying& carrying);
    void carry_equation(std::size_t c, Equation equation, Carrying& carrying);
    static void carry_set(std::size_t c, const CardReader& line, Entry& entry, Carrying& carrying);

    std::map<std::size_t, Read> read_;                        // by card, those of *EQUATION
    std::vector<std::pair<std::size_t, CardReader>> places_;  // by related equation: its card, and its last line
    RelatedNodes related_;
};

}  // namespace femscalpel
