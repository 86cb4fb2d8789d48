// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// Cards that name a node in a parameter: *RIGID BODY, *COUPLING (REF NODE=, ROT NODE=), *PRE-TENSION SECTION (NODE=).
/// The node does not move, and stays the original; that it was doubled or removed is told.
class ReferenceNodes : public CardRule {
public:
    bool takes(const Card& card) const override;
    bool can_change(const Card& card) const override;
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void mark(std::size_t c, const Card& card, Marking& marking) override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;
};

}  // namespace femscalpel
