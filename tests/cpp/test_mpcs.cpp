// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class MpcsRule : public RuleTest {};

TEST_F(MpcsRule, PlanesOfMpcsTakeInNewNodesOthersAreReported) {
    std::string plane = "*MPC\nPLANE";
    int count = 0;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) plane += (count++ == 12 ? "\n0, " : ", ") + std::to_string(node_at(i, j, 2));
    const std::string line = "MEANROT, 33, 38, 43, 99";
    const Mesh mesh = block_with("*NODE\n99, 2., 1., 5.\n" + plane + "\n" + line + "\n");
    const Mesh after = crack_at(mesh, 2);
    std::set<Index> on_plane;
    for (const Row& r : rows(after, "MPC"))
        if (r[0] == "PLANE" || r[0] == "0")
            for (std::size_t k = 1; k < r.size(); ++k) on_plane.insert(std::stoll(r[k]));
    EXPECT_EQ(on_plane, nodes_where(after, [](const Vec3& p) { return p.z() == 2; }));
    EXPECT_EQ(rows(after, "MPC").back()[0], "MEANROT");
    EXPECT_THAT(warnings_,
                Contains(AllOf(HasSubstr(at_line(line)), HasSubstr("node 33 and 2 more"), HasSubstr("MEANROT"))));
}

TEST_F(MpcsRule, NodesBetweenThoseOfOtherMpcsAreTold) {
    const std::string line = "MEANROT, " + std::to_string(node_at(1, 0, 2)) + ", " + std::to_string(node_at(2, 0, 2)) +
                             ", " + std::to_string(node_at(2, 1, 2)) + ", 99";
    const Mesh mesh = block_with("*NODE\n99, 2., 1., 5.\n*MPC\n" + line + "\n");
    crack_at(mesh, 1.5);
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr(at_line(line)), HasSubstr("MEANROT"), HasSubstr("do not join"))));
    EXPECT_THROW(crack_at(mesh, 1.5, "CRACK", Vec3(1, 0, 0), true), Error);
}

TEST_F(MpcsRule, NodesArePinned) { EXPECT_THAT(pinned("*MPC\nPLANE, 1, 2\n0, 4\nBEAM, 5\n"), ElementsAre(1, 2, 4, 5)); }

TEST_F(MpcsRule, ListsTakeInNewNodes) {
    const Carried after = carried("*MPC\nPLANE, 1, 2, 3\n0, 4\n", halve_element_1);
    EXPECT_EQ(after.cards, "*MPC\nPLANE, 1, 2, 3\n0, 4\n0, 6\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(MpcsRule, ListsLoseRemovedNodes) {
    const Carried after = carried("*MPC\nSTRAIGHT, 1, 5, 3\n", remove_element_2);
    EXPECT_EQ(after.cards, "*MPC\nSTRAIGHT, 1, 3\n");
    EXPECT_THAT(after.warnings, ElementsAre("deck.inp:11: *MPC names node 5, which was removed, and leaves the list"));
}

TEST_F(MpcsRule, LinesThatGoOnNeedNoZeroAndKeepTheirs) {
    EXPECT_THAT(pinned("*MPC\nPLANE, 1, 2\n3, 4\n"), ElementsAre(1, 2, 3, 4));
    EXPECT_EQ(carried("*MPC\nPLANE, 3, 4\n1, 2\n", halve_element_1).cards, "*MPC\nPLANE, 3, 4\n1, 2\n0, 6\n");
    EXPECT_EQ(carried("*MPC\nPLANE, 1, 3\n0, 5, 4\n", remove_element_2).cards, "*MPC\nPLANE, 1, 3\n0, 4\n");
    EXPECT_EQ(carried("*MPC\nPLANE, 1, 3\n5\n4, 2\n", remove_element_2).cards, "*MPC\nPLANE, 1, 3\n4, 2\n");
}

TEST_F(MpcsRule, OtherTypesStayAndAreTold) {
    const std::string cards = "*MPC\nMEANROT, 1, 2, 5\n";
    const Carried born = carried(cards, halve_element_1);
    EXPECT_EQ(born.cards, cards);
    EXPECT_THAT(born.warnings,
                ElementsAre("deck.inp:11: *MPC: new nodes (1 node, the first is 6) lie between nodes of this MEANROT "
                            "MPC and do not join it"));
    const Carried doubled = carried(cards, double_node_2);
    EXPECT_EQ(doubled.cards, cards);
    EXPECT_THAT(doubled.warnings,
                ElementsAre("deck.inp:11: *MPC names node 2, which the crack doubled; the MEANROT MPC stays "
                            "with the original, on the negative side"));
    const Carried removed = carried(cards, remove_element_2);
    EXPECT_EQ(removed.cards, cards);
    EXPECT_THAT(removed.warnings, ElementsAre("deck.inp:11: *MPC names node 5, which was removed"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
