// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// *TIE and *CONTACT PAIR: two surfaces on a line. They follow the mesh's groups; one without members is told of.
class SurfacePairs : public CardRule {
public:
    bool takes(const Card& card) const override;
    bool can_change(const Card& /*card*/) const override { return false; }
    int names_per_line() const override { return 2; }
};

}  // namespace femscalpel
