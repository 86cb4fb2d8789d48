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

TEST_F(ForeignResultsRule, FieldsOfFilesHaveNothingAtNewNodes) {
    const std::string cards =
        "*TEMPERATURE, FILE=heat.frd, BSTEP=1\n*INITIAL CONDITIONS, TYPE=VELOCITY, FILE=a\n*BOUNDARY, FILE=a\n"
        "*TEMPERATURE, FILE=heat.frd\n1, 5.\n2, 5.\n";
    const Carried after = carried(cards, halve_element_1);
    EXPECT_EQ(after.cards, cards + "6,5.\n") << "with lines the file means nothing";
    const std::string why =
        ", FILE takes values by number from results of the mesh as it was: new nodes have none there, and CalculiX "
        "gives them zero; compute them anew";
    EXPECT_THAT(after.warnings, ElementsAre("deck.inp:10: *TEMPERATURE" + why, "deck.inp:11: *INITIALCONDITIONS" + why,
                                            "deck.inp:12: *BOUNDARY" + why));
}

TEST_F(ForeignResultsRule, SensitivitiesThatAreReadAreTold) {
    EXPECT_THAT(carried("*CLOAD\n1, 1, 1.\n*SENSITIVITY\n*SENSITIVITY, WRITE\n", double_node_2).warnings, IsEmpty());
    EXPECT_THAT(
        carried("*SENSITIVITY, READ\n", double_node_2).warnings,
        ElementsAre(testing::StartsWith("deck.inp:10: *SENSITIVITY, READ needs results of the mesh as it was")));
}

TEST_F(ForeignResultsRule, ModesThatTheDeckDoesNotMakeAreTold) {
    const std::string modal = "*MODAL DYNAMIC\n0.1, 1.\n";
    EXPECT_THAT(carried("*FREQUENCY, STORAGE=YES\n5\n*END STEP\n*STEP\n" + modal, double_node_2).warnings, IsEmpty());
    for (const std::string& card :
         {modal, std::string("*STEADY STATE DYNAMICS\n1., 2.\n"), std::string("*COMPLEX FREQUENCY, CORIOLIS\n5\n")})
        EXPECT_THAT(carried(card, double_node_2).warnings,
                    ElementsAre(testing::HasSubstr("needs eigenmodes of the mesh as it was")))
            << card;
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
