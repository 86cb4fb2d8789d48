// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class EquationsRule : public RuleTest {};

TEST_F(EquationsRule, EquationsStayWithTheOriginalsAndTheirNodesDoNotMove) {
    const std::string a = std::to_string(node_at(2, 0, 2)), b = std::to_string(node_at(1, 0, 2));
    const std::string line = a + ", 1, 1., " + b + ", 1, -1.";
    const Mesh mesh = block_with("*EQUATION\n2\n" + line + "\n");
    const Mesh untouched = crack_at(mesh, 1.6);
    EXPECT_EQ(place(untouched, node_at(2, 0, 2)), Vec3(2, 0, 2));
    EXPECT_EQ(place(untouched, node_at(1, 0, 2)), Vec3(1, 0, 2));
    EXPECT_THAT(warnings_, Not(Contains(HasSubstr("EQUATION"))));
    const Mesh after = crack_at(mesh, 2);
    EXPECT_THAT(rows(after, "EQUATION"), ElementsAre(ElementsAre("2"), ElementsAre(a, "1", "1.", b, "1", "-1.")));
    EXPECT_THAT(warnings_,
                Contains(AllOf(HasSubstr(at_line(line) + "*EQUATION names node " + a), HasSubstr("negative side"))));
    try {
        crack_at(mesh, 2, "CRACK", Vec3(1, 0, 0), true);
        FAIL() << "strict accepted a doubled term";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("strict"), HasSubstr(at_line(line))));
    }
}

TEST_F(EquationsRule, SetsInEquationsKeepTheirSize) {
    std::string cards = "*NSET, NSET=A\n", other = "*NSET, NSET=B\n";
    for (int i = 0; i <= nx; ++i) {
        cards += std::to_string(node_at(i, 0, 2)) + "\n";
        other += std::to_string(node_at(i, 2, 2)) + "\n";
    }
    const Mesh mesh = block_with(cards + other + "*EQUATION\n3\nA, 1, 1., B, 1, -1.,\n13, 1, .5\n*CLOAD\nA, 1, 1.\n");
    const Mesh after = crack_at(mesh, 1.5, "CRACK", Vec3(1, 0, 0));
    EXPECT_THAT(rows(after, "EQUATION"),
                ElementsAre(ElementsAre("3"), ElementsAre("A_LOAD1", "1", "1.", "B_LOAD1", "1", "-1."),
                            ElementsAre("13", "1", ".5")));
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre("A_LOAD1", "1", "1.")));
    EXPECT_EQ(node_set(after, "A_LOAD1").size(), 5u);
    for (int i = 0; i <= nx; ++i) EXPECT_EQ(place(after, node_at(i, 0, 2)), Vec3(i, 0, 2));
}

TEST_F(EquationsRule, NodesOfTermsArePinnedAndThoseByNumberRelated) {
    const std::string cards =
        "*NSET, NSET=A\n5\n*EQUATION\n2\n1, 1, 1., A, 1,\n-1.\n*EQUATION, REMOVE\n3, 1\n*NETWORK MPC\n1\n4, 1, 1.\n";
    EXPECT_THAT(pinned(cards), ElementsAre(1, 4, 5));
    EXPECT_THAT(mark_deck(two_tetras(cards)).related, ElementsAre(0, 3));
}

TEST_F(EquationsRule, NodesBornBetweenRelatedOnesAreRelated) {
    const Carried after = carried("*EQUATION\n2\n1, 1, 1., 5, 1, -1.\n2\n2, 1, 1., 5, 1, -1.\n", halve_element_1);
    EXPECT_EQ(after.cards, "*EQUATION\n2\n1, 1, 1., 5, 1, -1.\n2\n6, 1, 1., 5, 1, -1.\n2\n2, 1, 1., 5, 1, -1.\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(EquationsRule, TermsStayOnOriginalsAndOldMembersAndThatIsTold) {
    const Carried after =
        carried("*NSET, NSET=A\n2, 3\n*NETWORK MPC\n3\n1, 1, 1., 2, 1, -1.\nA, 1, .5\n", double_node_2);
    EXPECT_EQ(after.cards,
              "*NSET, NSET=A\n2, 3\n*NSET, NSET=A_LOAD1\n*NETWORK MPC\n3\n1, 1, 1., 2, 1, -1.\nA_LOAD1, 1, .5\n");
    EXPECT_THAT(
        after.warnings,
        ElementsAre("deck.inp:15: *NETWORKMPC names set 'A', which has new nodes; the equations stay with the nodes it "
                    "had ('A_LOAD1')",
                    "deck.inp:14: *NETWORKMPC names node 2, which the crack doubled; the equation stays with the "
                    "original, on the negative side"));
}

TEST_F(EquationsRule, EquationsWithRemovedNodesAreLeftOutWhole) {
    const Carried after = carried("*EQUATION\n2\n1, 1, 1.\n5, 1, -1.\n2\n1, 2, 1., 3, 2, -1.\n", remove_element_2);
    EXPECT_EQ(after.cards, "*EQUATION\n2\n1, 2, 1., 3, 2, -1.\n");
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:13: *EQUATION names node 5, which was removed; its equation is left out"));
}

TEST_F(EquationsRule, WhatIsNoEquationIsTold) {
    const std::string cards = "*EQUATION\n2\n1, 1, 1., 3, 1, -1.\nX\n4, 1, 1.\n";
    const Carried after = carried(cards, double_node_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:13: *EQUATION: no equation can be read here; the rest of the card is "
                            "kept as it is"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
