// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/quality.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class NodeLoadsRule : public RuleTest {};

TEST_F(NodeLoadsRule, ConcentratedLoadOnADoubledNodeStaysWholeAndIsReported) {
    const std::string line = std::to_string(node_at(2, 2, 2)) + ", 2, -7.5";
    const Mesh mesh = block_with("*STEP\n*STATIC\n*CLOAD\n" + line + "\n*END STEP\n");
    const Mesh after = crack_at(mesh, 2);
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre(std::to_string(node_at(2, 2, 2)), "2", "-7.5")));
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr(at_line(line)), HasSubstr("*CLOAD names node 43"),
                                          HasSubstr("negative side"))));
    // It is known what happens to it: strict accepts that.
    crack_at(mesh, 2, "CRACK", Vec3(1, 0, 0), true);
    // The original is on the negative side.
    std::set<Index> negative;
    for (const Index e : element_set(after, "EALL")) {
        const CellRef c = *NumberIndex(after).cell(e);
        if (cell_measure(after, c.type, c.cell) <= 0) continue;
        const auto n = after.block(c.type).nodes(c.cell);
        double x = 0;
        for (const Index v : n) x += after.points[v].x() / 4;
        if (x < 2)
            for (const Index v : n) negative.insert(after.node_ids[v]);
    }
    EXPECT_TRUE(negative.contains(node_at(2, 2, 2)));
}

TEST_F(NodeLoadsRule, LoadedNodesByNumberDoNotMove) {
    std::string cards = "*STEP\n*STATIC\n*CLOAD\n";
    for (int i = 0; i <= nx; ++i) cards += std::to_string(node_at(i, 2, 2)) + ", 2, " + std::to_string(i + 1) + ".\n";
    const Mesh after = crack_at(block_with(cards + "*END STEP\n"), 1.8, "CRACK", Vec3(1, .3, .2));
    for (int i = 0; i <= nx; ++i) EXPECT_EQ(place(after, node_at(i, 2, 2)), Vec3(i, 2, 2));
    EXPECT_EQ(rows(after, "CLOAD").size(), 5u);
}

TEST_F(NodeLoadsRule, LoadOnASetKeepsItsTotalAlsoUnderASecondCrack) {
    std::string cards = "*NSET, NSET=TOP\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) cards += std::to_string(node_at(i, j, 2)) + ",\n";
    const std::string line = "TOP, 3, -2.";
    const Mesh mesh = block_with(cards + "*STEP\n*STATIC\n*CLOAD\n" + line + "\n*CFLUX\nTOP, 11, 1.\n*END STEP\n");
    Mesh after = crack_at(mesh, 1.5);
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre("TOP_LOAD1", "3", "-2.")));
    EXPECT_THAT(rows(after, "CFLUX"), ElementsAre(ElementsAre("TOP_LOAD1", "11", "1.")));
    EXPECT_EQ(node_set(after, "TOP_LOAD1").size(), 15u);
    EXPECT_GT(node_set(after, "TOP").size(), 15u);
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr(at_line(line)), HasSubstr("TOP_LOAD1"))));

    // Without writing the deck in between: the set is known to be closed.
    CrackOptions options;
    options.name = "A";
    const Result first = crack(mesh, Plane(Vec3(1.5, 1, 1), Vec3(1, 0, 0)), options);
    options.name = "B";
    const Result second = crack(first.mesh, Plane(Vec3(2.5, 1, 1), Vec3(1, 0, 0)), options);
    EXPECT_THAT(rows(second.mesh, "CLOAD"), ElementsAre(ElementsAre("TOP_LOAD1", "3", "-2.")));
    EXPECT_EQ(node_set(second.mesh, "TOP_LOAD1").size(), 15u);
    // And with: then it is a set like others, and gets one of its own.
    after = crack_at(after, 2.5, "B");
    ASSERT_EQ(rows(after, "CLOAD").size(), 1u);
    EXPECT_EQ(node_set(after, rows(after, "CLOAD")[0][0]).size(), 15u);
}

TEST_F(NodeLoadsRule, NodesByNumberArePinned) {
    EXPECT_THAT(pinned("*CLOAD\n3, 1, 1.\nNALL, 2, 1.\n*CFLUX\n1, 11, 1.\n*RETAINED NODAL DOFS\n5, 1, 3\n"
                       "*DISTRIBUTING COUPLING, ELSET=EALL\n4, .5\n"),
                ElementsAre(1, 3, 4, 5));
}

TEST_F(NodeLoadsRule, LoadsStayWholeOnOriginalsAndOldMembers) {
    const Carried after = carried("*NSET, NSET=A\n1, 2\n*CLOAD\n2, 1, 1.\nA, 2, 4.\n", double_node_2);
    EXPECT_EQ(after.cards, "*NSET, NSET=A\n1, 2\n*NSET, NSET=A_LOAD1\n*CLOAD\n2, 1, 1.\nA_LOAD1, 2, 4.\n");
    EXPECT_THAT(node_set(after.mesh, "A_LOAD1"), ElementsAre(1, 2));
    EXPECT_THAT(node_set(after.mesh, "A"), ElementsAre(1, 2, 6));
    EXPECT_THAT(
        after.warnings,
        ElementsAre(
            "deck.inp:14: *CLOAD names set 'A', which has new nodes; the card now names 'A_LOAD1', the nodes it "
            "had, so that the total stays the same",
            "deck.inp:13: *CLOAD names node 2, which the crack doubled; its load stays whole on the "
            "original, on the negative side"));
}

TEST_F(NodeLoadsRule, RemovedNodesTakeTheirLoadsWithThem) {
    const Carried after = carried("*CLOAD\n5, 1, 1.\n4, 1, 2.\nNALL, 3, 1.\n", remove_element_2);
    EXPECT_EQ(after.cards, "*CLOAD\n4, 1, 2.\nNALL, 3, 1.\n");
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:13: *CLOAD names set 'NALL', which lost 1 node and with it its load",
                            "deck.inp:11: *CLOAD names node 5, which was removed, and with it the load"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
