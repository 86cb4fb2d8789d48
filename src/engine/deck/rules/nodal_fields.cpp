// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/nodal_fields.h"

#include "deck/card_numbers.h"

namespace femscalpel {

bool NodalFields::takes(const Card& card) const {
    return card.keyword == "TEMPERATURE" || card.keyword == "NODALTHICKNESS" || card.keyword == "INITIALCONDITIONS";
}

bool NodalFields::tells_of_made(const Card& card) const { return card.keyword == "INITIALCONDITIONS"; }

std::optional<NodalRule::Values> NodalFields::read_values(CardReader& line, const Card& /*card*/,
                                                          Remarks& /*remarks*/) const {
    Values out;
    double value = 0;
    for (int column = 0; !line.at_end() && line.number(value); ++column) out[column] = value;
    return out;
}

std::vector<std::string> NodalFields::lines(Index number, const Values& wanted, const Values& given) const {
    if (has_all(given, wanted)) return {};
    std::string text = std::to_string(number) + ",";
    for (int column = 0; column <= wanted.rbegin()->first; ++column)
        text += (column > 0 ? "," : "") + (wanted.contains(column) ? number_text(wanted.at(column)) : std::string());
    return {text};
}

}  // namespace femscalpel
