// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class ReferenceNodesRule : public RuleTest {};

TEST_F(ReferenceNodesRule, ArePinnedAndStay) {
    const std::string cards =
        "*NSET, NSET=R\n1\n*RIGID BODY, NSET=R, REF NODE=4, ROT NODE=5\n*PRE-TENSION SECTION, SURFACE=S, NODE=3\n1., "
        "0., 0.\n";
    EXPECT_THAT(pinned(cards), ElementsAre(3, 4, 5));
    const Carried after = carried(cards, double_node_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(ReferenceNodesRule, DoubledAndRemovedOnesAreTold) {
    const Carried doubled =
        carried("*COUPLING, CONSTRAINT NAME=C, SURFACE=S, REF NODE=2\n*KINEMATIC\n1, 3\n", double_node_2);
    EXPECT_THAT(doubled.warnings,
                ElementsAre("deck.inp:10: *COUPLING names node 2, which the crack doubled; REF NODE stays the "
                            "original, on the negative side"));
    const Carried removed = carried("*RIGID BODY, NSET=NALL, REF NODE=1, ROT NODE=5\n", remove_element_2);
    EXPECT_THAT(removed.warnings,
                ElementsAre("deck.inp:10: *RIGIDBODY names node 5, which was removed; give another ROT NODE"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
