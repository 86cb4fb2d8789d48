// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class ForeignResultsRule : public RuleTest {};

TEST_F(ForeignResultsRule, NothingIsSaidOfResultsThatTheDeckMakes) {
    const std::string cards = "*CLOAD\n1, 1, 1.\n*RESTART, WRITE\n*VIEWFACTOR, WRITE\n*VIEWFACTOR, READ\n";
    const Carried after = carried(cards, double_node_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(ForeignResultsRule, ResultsOfTheMeshAsItWasAreTold) {
    const std::string cards = "*RESTART, READ\n*VIEWFACTOR, READ\n";
    const Carried after = carried(cards, double_node_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(
        after.warnings,
        ElementsAre("deck.inp:10: *RESTART, READ needs results of the mesh as it was; the changed mesh has other nodes "
                    "and elements",
                    "deck.inp:11: *VIEWFACTOR, READ needs view factors of the mesh as it was; compute them anew"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
