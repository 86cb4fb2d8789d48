// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/element_values.h"

#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"

namespace femscalpel {

bool ElementValues::takes(const Card& card) const { return card.keyword == "DISTRIBUTION"; }

void ElementValues::list_numbers(const Card& card, AbsentNumbers& numbers) const { numbers.name_elements_first(card); }

void ElementValues::carry(std::size_t c, const Card& card, Carrying& carrying) {
    CardEdits& edits = carrying.edits(c);
    CardReader line(card);
    while (line.next_data_line()) {
        const auto what = read_number_or_set(line);
        if (!what || !what->is_number() || !carrying.had_element(what->number)) continue;
        if (!carrying.new_numbers().cell(what->number)) edits.drop(line);
        const std::vector<Index> parts = carrying.parts_of(what->number);
        if (parts.empty())
            carrying.remarks().add(c, Weight::problem, line.where(), the_element(what->number), "was removed");
        for (const Index part : parts)
            if (part != what->number) edits.add_after(line, std::to_string(part) + "," + std::string(line.rest()));
    }
}

}  // namespace femscalpel
