// SPDX-License-Identifier: LGPL-2.1-or-later
// That values go to the nearest points is tested with CalculiX, in tests/python/test_initial_state.py.
#include "deck/rules/point_values.h"

#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class PointValuesRule : public RuleTest {};

TEST_F(PointValuesRule, AreThoseOfIntegrationPoints) {
    for (const auto& [text, taken] : {std::pair("*INITIAL CONDITIONS, TYPE=STRESS\n", true),
                                      {"*INITIAL CONDITIONS, TYPE=PLASTIC STRAIN\n", true},
                                      {"*INITIAL CONDITIONS, TYPE=SOLUTION\n", true},
                                      {"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n", false},
                                      {"*DISTRIBUTION, NAME=D\n", false}}) {
        Card card;
        card.set_text(text);
        EXPECT_EQ(PointValues().takes(card), taken) << text;
    }
}

TEST_F(PointValuesRule, PartsOfOnePointHaveItsValues) {
    const Carried after =
        carried("*INITIAL CONDITIONS, TYPE=STRESS\n1, 1, 7., 0., 0., 0., 0., 0.\n2, 1, 8., 0., 0., 0., 0., 0.\n",
                halve_element_1);
    EXPECT_EQ(after.cards,
              "*INITIAL CONDITIONS, TYPE=STRESS\n1, 1, 7., 0., 0., 0., 0., 0.\n3, 1, 7., 0., 0., 0., 0., 0.\n"
              "2, 1, 8., 0., 0., 0., 0., 0.\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(PointValuesRule, RecordsOfWholeElementsStayAsTheyAre) {
    const std::string cards = "*INITIAL CONDITIONS, TYPE=STRESS\n2, 1, 8., 0.,  0., 0., 0., 0.\nEALL, 1., 2.\n";
    const Carried after = carried(cards, halve_element_1);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings, IsEmpty());
}

/// A point that the element has not: where the values were meant is not known.
TEST_F(PointValuesRule, PointsThatTheElementHasNotAreAProblem) {
    const Carried after =
        carried("*INITIAL CONDITIONS, TYPE=STRESS\n1, 1, 7., 0., 0., 0., 0., 0.\n1, 2, 9., 0., 0., 0., 0., 0.\n",
                halve_element_1);
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:11: *INITIALCONDITIONS names element 1, which was split; the values "
                            "at its integration points are given to those of each part"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
