// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/deck_view.h"
#include "deck/rules/card_rule.h"

namespace femscalpel {

/// *MODEL CHANGE, TYPE=ELEMENT: a list of elements and sets. The elements by number are a group whose shape is kept;
/// parts of an element take its place. Of other types it names contact pairs.
class ModelChanges : public CardRule {
public:
    bool takes(const Card& card) const override { return card.keyword == "MODELCHANGE"; }
    bool can_change(const Card& card) const override { return type_of(card) == "ELEMENT"; }
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void mark(std::size_t c, const Card& card, Marking& marking) override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;
};

}  // namespace femscalpel
