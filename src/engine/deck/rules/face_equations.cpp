// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/face_equations.h"

#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"

namespace femscalpel {

void FaceEquations::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    CardReader line(card);
    while (line.next_data_line())
        for (int k = 0; !line.at_end(); ++k) {
            Index element = 0;
            if (k % 4 != 0 || !line.integer(element))
                line.field();
            else if (k > 0 || !line.at_end())  // not the number of terms
                numbers.name_element(line, element);
        }
}

void FaceEquations::carry(std::size_t c, const Card& card, Carrying& carrying) {
    CardReader line(card);
    while (line.next_data_line())
        for (int k = 0; !line.at_end(); ++k) {
            Index element = 0;
            if (k % 4 != 0 || !line.integer(element)) {
                line.field();
                continue;
            }
            if (k == 0 && line.at_end()) break;  // the number of terms
            if (carrying.had_element(element) && carrying.parts_of(element) != std::vector<Index>{element})
                carrying.remarks().add(c, Weight::problem, line.where(), the_element(element),
                                       "was split or removed; the equation is kept as it is");
        }
}

}  // namespace femscalpel
