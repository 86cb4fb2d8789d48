// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/supports.h"

#include <algorithm>

#include "deck/card_numbers.h"
#include "deck/rules/marking.h"

namespace femscalpel {

void Supports::mark(std::size_t c, const Card& card, Marking& marking) {
    const std::string group = "NODES" + std::to_string(marking.deck().step(c)) + parameters_key(card) + ":";
    CardReader line(card);
    while (const auto what = next_entry(line))
        if (what->is_number()) marking.mark_node(group + deck_key(line.rest()), what->number);
}

std::optional<NodalRule::Values> Supports::read_values(CardReader& line, const Card& card, Remarks& remarks) const {
    Index first = 0, last = 0;
    if (!line.integer(first)) {
        remarks.add_problem(line.where() + "*" + card.keyword + ": '" + line.field() +
                            "' is no degree of freedom; the line is kept as it is");
        return {};
    }
    if (line.at_end() || !line.integer(last)) {
        line.field();
        last = first;
    }
    if (last == 0) last = first;
    double value = 0;
    if (!line.at_end()) line.number(value);
    Values out;
    for (Index dof = first; dof <= std::min<Index>(last, first + 100); ++dof) out[static_cast<int>(dof)] = value;
    return out;
}

std::vector<std::string> Supports::lines(Index number, const Values& wanted, const Values& given) const {
    std::vector<std::string> out;
    for (auto it = wanted.begin(); it != wanted.end();) {
        const auto [dof, value] = *it++;
        if (has(given, dof, value)) continue;
        int last = dof;
        while (it != wanted.end() && it->first == last + 1 && it->second == value &&
               !has(given, it->first, it->second)) {
            ++last;
            ++it;
        }
        out.push_back(std::to_string(number) + "," + std::to_string(dof) + "," + std::to_string(last) +
                      (value == 0 ? "" : "," + number_text(value)));
    }
    return out;
}

}  // namespace femscalpel
