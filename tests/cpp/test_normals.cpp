// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class NormalsRule : public RuleTest {};

TEST_F(NormalsRule, NodesArePinned) {
    EXPECT_THAT(pinned("*NORMAL\n1, 3, 0., 0., 1.\n2, 4, 0., 0., 1.\n"), ElementsAre(3, 4));
}

TEST_F(NormalsRule, PartsAndCopiesGetTheNormal) {
    // Of element 1 only part 3 has node 2.
    EXPECT_EQ(carried("*NORMAL\n1, 2, 0., 0., 1.\n1, 3, 0., 1., 0.\n", halve_element_1).cards,
              "*NORMAL\n3, 2, 0., 0., 1.\n1, 3, 0., 1., 0.\n3, 3, 0., 1., 0.\n");
    EXPECT_EQ(carried("*NORMAL\n1, 2, 0., 0., 1.\n2, 2, 0., 1., 0.\n", double_node_2).cards,
              "*NORMAL\n1, 2, 0., 0., 1.\n2, 6, 0., 1., 0.\n");
}

TEST_F(NormalsRule, ElementsThatLostTheNodeAreTold) {
    const Carried after = carried("*NORMAL\n2, 4, 0., 0., 1.\n1, 4, 0., 1., 0.\n", remove_element_2);
    EXPECT_EQ(after.cards, "*NORMAL\n1, 4, 0., 1., 0.\n");
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:11: *NORMAL names element 2, which has no longer the node of its normal"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
