// SPDX-License-Identifier: LGPL-2.1-or-later
#include <map>
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class NodalFieldsRule : public RuleTest {};

TEST_F(NodalFieldsRule, NodeFieldsAreInterpolatedWhereNodesAreNow) {
    std::string cards = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n*STEP\n*STATIC\n*TEMPERATURE\n";
    for (int k = 0; k <= nz; ++k)
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i)
                cards += std::to_string(node_at(i, j, k)) + ", " + std::to_string(i + 10 * j + 100 * k) + "\n";
    const Mesh mesh = block_with(cards + "*END STEP\n");
    const Mesh after = crack_at(mesh, 1.7, "CRACK", Vec3(1, .3, -.2));
    std::map<Index, double> t;
    for (const Row& r : rows(after, "TEMPERATURE")) t[std::stoll(r[0])] = std::stod(r[1]);
    ASSERT_EQ(t.size(), static_cast<std::size_t>(after.node_count()));
    for (const auto& [node, value] : t) EXPECT_NEAR(value, place(after, node).dot(Vec3(1, 10, 100)), 1e-9) << node;
    // What a set says for all needs no line.
    EXPECT_EQ(rows(after, "INITIALCONDITIONS").size(), 1u);
    EXPECT_THAT(warnings_, Not(Contains(HasSubstr("deck.inp"))));
}

TEST_F(NodalFieldsRule, CardsOfOneStepAreAsOneAndTheLastGetsTheLines) {
    const Carried after = carried(
        "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n*STEP\n*TEMPERATURE\n1, 300., 7.\n*TEMPERATURE\n2, 300., "
        "7.\n"
        "*END STEP\n",
        halve_element_1);
    EXPECT_EQ(
        after.cards,
        "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n*STEP\n*TEMPERATURE\n1, 300., 7.\n*TEMPERATURE\n2, 300., "
        "7.\n6,300.,7.\n*END STEP\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(NodalFieldsRule, ANodeBornAtTheBorderOfAFieldGetsNone) {
    const std::string cards = "*NODAL THICKNESS\n1, 2.\n";
    EXPECT_EQ(carried(cards, halve_element_1).cards, cards);
}

TEST_F(NodalFieldsRule, RemovedNodesAreTold) {
    const Carried after = carried("*TEMPERATURE\n5, 300.\n4, 200.\n", remove_element_2);
    EXPECT_EQ(after.cards, "*TEMPERATURE\n4, 200.\n");
    EXPECT_THAT(after.warnings, ElementsAre("deck.inp:11: *TEMPERATURE names node 5, which was removed"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
