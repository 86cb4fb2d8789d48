// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class FaceEquationsRule : public RuleTest {};

TEST_F(FaceEquationsRule, StayAsTheyAreIfTheirElementsDo) {
    const std::string cards = "*EQUATIONF\n2\n1, S1, 1, 1., 2, S2, 1, -1.\n";
    const Carried after = carried(cards, double_node_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(FaceEquationsRule, SplitAndRemovedElementsAreTold) {
    const std::string cards = "*EQUATIONF\n4\n1, S1, 1, 1., 2, S2, 1, -1.\n1, S1, 2, 1., 2, S2, 2, -1.\n";
    for (const auto& [change, element] :
         {std::pair<Change, std::string>(halve_element_1, "1"), {remove_element_2, "2"}}) {
        const Carried after = carried(cards, change);
        EXPECT_EQ(after.cards, cards);
        EXPECT_THAT(after.warnings, ElementsAre("deck.inp:12: *EQUATIONF names element " + element +
                                                ", which was split or removed; the equation is kept as it is"));
    }
}

TEST_F(FaceEquationsRule, NumbersOfTermsAreNoElements) {
    EXPECT_THAT(carried("*EQUATIONF\n1\n2, S1, 1, 1.\n", halve_element_1).warnings, IsEmpty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
