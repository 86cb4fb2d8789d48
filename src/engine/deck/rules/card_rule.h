// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>

#include "deck/solver_input.h"

namespace femscalpel {

class AbsentNumbers;
class Marking;
class Carrying;

/// What an operator has to keep for a family of cards, and what becomes of these cards in the changed mesh. One object
/// serves one walk over one deck, marking or carrying (mark_deck.h, carry_over.h), and may keep what it learns on the
/// way. The table of all rules is in rules.cpp.
class CardRule {
public:
    CardRule() = default;
    CardRule(const CardRule&) = delete;
    CardRule& operator=(const CardRule&) = delete;
    virtual ~CardRule() = default;

    /// Whether the rule is that of this card. The first rule of the table that takes a card has it.
    virtual bool takes(const Card& card) const = 0;
    /// Whether there can be anything to change or to tell of this card, sets without members aside.
    virtual bool can_change(const Card& /*card*/) const { return true; }
    /// How many entries at the start of a line may name sets or surfaces: that these, or those in the card's
    /// parameters, lost all members is told (emptied_sets.h). With 0 the rule tells of sets itself, or need not.
    virtual int names_per_line() const { return 1; }

    /// Names to `numbers` each node and element that the card has by number.
    virtual void list_numbers(const Card& /*card*/, AbsentNumbers& /*numbers*/) const {}

    /// Marks what card `c` of the deck names and an operator has to keep.
    virtual void mark(std::size_t /*c*/, const Card& /*card*/, Marking& /*marking*/) {}
    /// After all cards are marked.
    virtual void end_marking(Marking& /*marking*/) {}

    /// Before any card is carried over.
    virtual void begin_carrying(Carrying& /*carrying*/) {}
    /// Edits card `c` of the deck so that it says of the changed mesh what it said, or tells that it does not.
    virtual void carry(std::size_t /*c*/, const Card& /*card*/, Carrying& /*carrying*/) {}
    /// After all cards are carried over.
    virtual void end_carrying(Carrying& /*carrying*/) {}
};

}  // namespace femscalpel
