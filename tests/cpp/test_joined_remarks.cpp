// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/joined_remarks.h"

#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace rule_testing;

/// Of two tetrahedra, first element 1 was halved: node 6 is between 1 and 2, element 3 the half at node 2.
class JoinedRemarksTest : public RuleTest {
protected:
    std::vector<std::string> problems(const Mesh& after) const {
        const JoinedRemarks joined(first, halved, second, {}, after, deck);
        std::vector<std::string> out = joined.first().problems();
        for (const std::string& text : joined.second().problems()) out.push_back(text);
        return out;
    }

    /// Says on the second change that `entity` was removed.
    void add_removed(const Entity& entity) {
        second.add(card, Weight::problem, "deck.inp:11 (carried over): ", entity, "was removed");
    }

    const Mesh input = two_tetras("*CLOAD\n1, 1, 1.\n");
    const SolverInput& deck = *solver_input(input);
    const std::size_t card = deck.cards().size() - 1;
    Mesh between = input;
    Changes halved;
    Remarks first{deck}, second{deck};

    void SetUp() override {
        RuleTest::SetUp();
        halve_element_1(between, halved);
    }
};

TEST_F(JoinedRemarksTest, NewNodesThatWentAgainAreNotTold) {
    first.add_new_nodes("deck.inp:10: *EQUATION: ", {6}, "are not related");
    EXPECT_THAT(problems(between),
                ElementsAre("deck.inp:10: *EQUATION: new nodes (1 node, the first is 6) are not related"));
    first.add_new_nodes("deck.inp:12: *EQUATION: ", {6, 5}, "are not related");
    EXPECT_THAT(problems(input),
                ElementsAre("deck.inp:12: *EQUATION: new nodes (1 node, the first is 5) are not related"));
}

TEST_F(JoinedRemarksTest, NodesAreThoseOfTheInputOrTheResult) {
    add_removed(the_node(1));
    add_removed(the_node(6));
    EXPECT_THAT(problems(between),
                ElementsAre("deck.inp:11: *CLOAD names node 1 and 1 more, each of which was removed"));
    EXPECT_THAT(problems(input), ElementsAre("deck.inp:11: *CLOAD names node 1, which was removed"))
        << "6 came and went";
}

TEST_F(JoinedRemarksTest, ElementsAreRemovedWhenNothingIsLeftOfThem) {
    add_removed(the_element(3));
    EXPECT_THAT(problems(input), IsEmpty()) << "half of element 1 is left";
    Mesh after = between;
    tetras(after).ids = {7, 2, 8};
    EXPECT_THAT(problems(after), ElementsAre("deck.inp:11: *CLOAD names element 1, which was removed"));
    add_removed(the_element(1));
    EXPECT_THAT(problems(after), ElementsAre("deck.inp:11: *CLOAD names element 1, which was removed")) << "once";
}

TEST_F(JoinedRemarksTest, SetsHaveTheNamesOfTheInput) {
    first.add_replaced("ENDS", "ENDS_LOAD1");
    add_removed(the_set("ends_load1"));
    add_removed(the_set("OTHER", "node set"));
    EXPECT_THAT(problems(between),
                ElementsAre("deck.inp:11: *CLOAD names set 'ENDS' and 1 more, each of which was removed"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
