// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// What nodes have each for itself, so that the sum counts: *CLOAD, *CFLUX, *DISTRIBUTING COUPLING, *RETAINED NODAL
/// DOFS. A node named by number keeps its load whole, and does not move; of a doubled node that is the original, on the
/// crack's negative side. Where a set has new members the card names a closed set of the old ones (closed_sets.h).
class NodeLoads : public CardRule {
public:
    bool takes(const Card& card) const override;
    int names_per_line() const override { return 0; }
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void mark(std::size_t c, const Card& card, Marking& marking) override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

private:
    static bool is_load(const Card& card) { return card.keyword == "CLOAD" || card.keyword == "CFLUX"; }
};

}  // namespace femscalpel
