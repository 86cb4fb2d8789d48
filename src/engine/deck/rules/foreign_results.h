// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// Results of the mesh as it was that the deck reads: *RESTART, READ, and *VIEWFACTOR, READ, unless an earlier
/// *VIEWFACTOR of the deck makes them. That they are of another mesh is told.
class ForeignResults : public CardRule {
public:
    bool takes(const Card& card) const override;
    bool can_change(const Card& card) const override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

private:
    bool view_factors_made_ = false;
};

}  // namespace femscalpel
