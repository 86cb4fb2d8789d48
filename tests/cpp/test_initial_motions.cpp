// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class InitialMotionsRule : public RuleTest {};

TEST_F(InitialMotionsRule, CopiesMoveAsTheirOriginals) {
    const Carried after = carried(
        "*INITIAL CONDITIONS, TYPE=VELOCITY\n2, 1, 3.\n2, 2, -1.5\n*INITIAL CONDITIONS, TYPE=DISPLACEMENT\nNALL, 3, "
        "1.\n",
        double_node_2);
    EXPECT_EQ(after.cards,
              "*INITIAL CONDITIONS, TYPE=VELOCITY\n2, 1, 3.\n2, 2, -1.5\n6,1,3.\n6,2,-1.5\n"
              "*INITIAL CONDITIONS, TYPE=DISPLACEMENT\nNALL, 3, 1.\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(InitialMotionsRule, RemovedNodesAreTold) {
    const Carried after = carried("*INITIAL CONDITIONS, TYPE=VELOCITY\n5, 1, 3.\n4, 1, 2.\n", remove_element_2);
    EXPECT_EQ(after.cards, "*INITIAL CONDITIONS, TYPE=VELOCITY\n4, 1, 2.\n");
    EXPECT_THAT(after.warnings, ElementsAre("deck.inp:11: *INITIALCONDITIONS names node 5, which was removed"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
