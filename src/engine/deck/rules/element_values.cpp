// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/element_values.h"

#include <algorithm>

#include "deck/rules/carrying.h"

namespace femscalpel {
namespace {

/// Values are at integration points.
bool has_points(const Card& card) { return card.keyword == "INITIALCONDITIONS"; }

/// Largest number of state variables in the deck: records of initial solutions are as long.
Index state_variables(const std::vector<Card>& cards) {
    Index most = 0;
    for (const Card& card : cards) {
        if (card.keyword != "DEPVAR") continue;
        CardReader line(card);
        if (Index count = 0; line.next_data_line() && line.integer(count)) most = std::max(most, count);
    }
    return most;
}

}  // namespace

bool ElementValues::takes(const Card& card) const {
    if (card.keyword == "DISTRIBUTION") return true;
    if (card.keyword != "INITIALCONDITIONS") return false;
    const std::string type = type_of(card);
    return type == "STRESS" || type == "PLASTICSTRAIN" || type == "SOLUTION";
}

Index ElementValues::lines_per_record(const Card& card, const Carrying& carrying) {
    if (!has_points(card) || type_of(card) != "SOLUTION") return 1;
    // Two entries and six values on the first line of a record, eight on the others.
    return 1 + std::max<Index>(0, state_variables(carrying.old().cards()) - 6 + 7) / 8;
}

void ElementValues::carry(std::size_t c, const Card& card, Carrying& carrying) {
    const Index lines = lines_per_record(card, carrying);
    CardEdits& edits = carrying.edits(c);
    CardReader line(card);
    while (line.next_data_line()) {
        const auto what = read_number_or_set(line);
        std::string rest(line.rest());
        const bool known = what && what->is_number() && carrying.had_element(what->number);
        const std::vector<Index> parts = known ? carrying.parts_of(what->number) : std::vector<Index>{};
        const bool gone = known && !carrying.new_numbers().cell(what->number);
        const std::string where = line.where();
        if (gone) edits.drop(line);
        for (Index k = 1; k < lines && line.next_data_line(); ++k) {
            rest += "\n" + std::string(line.line());
            if (gone) edits.drop(line);
        }
        if (!known) continue;
        Remarks& remarks = carrying.remarks();
        if (parts.empty()) remarks.add(c, Weight::problem, where, the_element(what->number), "was removed");
        const CellType cell = carrying.old().numbers().cell(what->number)->type;
        if (has_points(card) && parts.size() > 1 && cell != CellType::tetra && cell != CellType::triangle)
            remarks.add(c, Weight::problem, where, the_element(what->number),
                        "was split; the values at its integration points are given to those of each part");
        for (const Index part : parts)
            if (part != what->number) edits.add_after(line, std::to_string(part) + "," + rest);
    }
}

}  // namespace femscalpel
