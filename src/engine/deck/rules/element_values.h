// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// Values of elements by number: *DISTRIBUTION. Parts of an element get what the element has.
class ElementValues : public CardRule {
public:
    bool takes(const Card& card) const override;
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;
};

}  // namespace femscalpel
