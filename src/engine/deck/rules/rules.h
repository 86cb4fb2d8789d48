// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <vector>

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// The rules for all cards of CalculiX up to 2.23, for one walk over a deck.
class CardRules {
public:
    CardRules();

    /// The rule of a card; null for a keyword that CalculiX does not have.
    CardRule* find(const Card& card) const;
    /// All rules, in the order of the table.
    const std::vector<std::unique_ptr<CardRule>>& all() const { return rules_; }

private:
    std::vector<std::unique_ptr<CardRule>> rules_;
};

}  // namespace femscalpel
