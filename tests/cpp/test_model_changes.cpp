// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class ModelChangesRule : public RuleTest {};

TEST_F(ModelChangesRule, ElementsByNumberAreAGroup) {
    EXPECT_THAT(
        marked("*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n2, EALL\n1\n*MODEL CHANGE, TYPE=CONTACT PAIR, ADD\n1, 2\n"),
        ElementsAre(ElementsAre(1, 2)));
}

TEST_F(ModelChangesRule, PartsTakeThePlaceOfTheElement) {
    const Carried after = carried("*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n1, EALL, 2\n2\n", halve_element_1);
    EXPECT_EQ(after.cards, "*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n1\n3\nEALL\n2\n2\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(ModelChangesRule, RemovedElementsAreTold) {
    const Carried after = carried("*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n2\n1\n", remove_element_2);
    EXPECT_EQ(after.cards, "*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n1\n");
    EXPECT_THAT(after.warnings, ElementsAre("deck.inp:11: *MODELCHANGE names element 2, which was removed"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
