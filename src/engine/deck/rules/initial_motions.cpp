// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/initial_motions.h"

#include "deck/card_numbers.h"

namespace femscalpel {

bool InitialMotions::takes(const Card& card) const {
    if (card.keyword != "INITIALCONDITIONS") return false;
    const std::string type = type_of(card);
    return type == "DISPLACEMENT" || type == "VELOCITY" || type == "FLUIDVELOCITY";
}

std::optional<NodalRule::Values> InitialMotions::read_values(CardReader& line, const Card& /*card*/,
                                                             Remarks& /*remarks*/) const {
    Index dof = 0;
    if (!line.integer(dof)) return {};
    double value = 0;
    if (!line.at_end()) line.number(value);
    return Values{{static_cast<int>(dof), value}};
}

std::vector<std::string> InitialMotions::lines(Index number, const Values& wanted, const Values& given) const {
    std::vector<std::string> out;
    for (const auto& [dof, value] : wanted)
        if (!has(given, dof, value))
            out.push_back(std::to_string(number) + "," + std::to_string(dof) + "," + number_text(value));
    return out;
}

}  // namespace femscalpel
