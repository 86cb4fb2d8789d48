// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/model_changes.h"

#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"
#include "deck/rules/marking.h"

namespace femscalpel {

void ModelChanges::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    if (!can_change(card)) return;
    CardReader line(card);
    while (line.next_data_line())
        for (const NumberOrSet& what : read_entries(line))
            if (what.is_number()) numbers.name_element(line, what.number);
}

void ModelChanges::mark(std::size_t c, const Card& card, Marking& marking) {
    if (!can_change(card)) return;
    CardReader line(card);
    while (line.next_data_line())
        for (const NumberOrSet& what : read_entries(line))
            if (what.is_number()) marking.mark_element("LIST" + std::to_string(c), what.number);
}

void ModelChanges::carry(std::size_t c, const Card& card, Carrying& carrying) {
    if (!can_change(card)) return;
    CardReader line(card);
    while (line.next_data_line()) {
        bool same = true;
        std::vector<std::string> entries;
        for (const NumberOrSet& what : read_entries(line)) {
            if (!what.is_number() || !carrying.had_element(what.number)) {
                entries.push_back(what.is_number() ? std::to_string(what.number) : what.set);
                continue;
            }
            const std::vector<Index> parts = carrying.parts_of(what.number);
            same = same && parts == std::vector<Index>{what.number};
            if (parts.empty())
                carrying.remarks().add(c, Weight::problem, line.where(), the_element(what.number), "was removed");
            for (const Index part : parts) entries.push_back(std::to_string(part));
        }
        if (same) continue;
        carrying.edits(c).drop(line);
        for (const std::string& entry : entries) carrying.edits(c).add_after(line, entry);
    }
}

}  // namespace femscalpel
