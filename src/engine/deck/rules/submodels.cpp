// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/submodels.h"

#include "deck/rules/absent_numbers.h"

namespace femscalpel {

void Submodels::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    if (can_change(card)) NodalRule::list_numbers(card, numbers);
}

void Submodels::carry(std::size_t c, const Card& card, Carrying& carrying) {
    if (can_change(card)) NodalRule::carry(c, card, carrying);
}

/// To be in the list is a value like another.
std::optional<NodalRule::Values> Submodels::read_values(CardReader& /*line*/, const Card& /*card*/,
                                                        Remarks& /*remarks*/) const {
    return Values{{0, 0}};
}

std::vector<std::string> Submodels::lines(Index number, const Values& wanted, const Values& given) const {
    if (has_all(given, wanted)) return {};
    return {std::to_string(number) + ","};
}

}  // namespace femscalpel
