// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// *EQUATIONF, terms of element, face, degree of freedom and coefficient: stay as they are; a split or removed element
/// is told of.
class FaceEquations : public CardRule {
public:
    bool takes(const Card& card) const override { return card.keyword == "EQUATIONF"; }
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;
};

}  // namespace femscalpel
