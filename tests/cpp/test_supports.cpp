// SPDX-License-Identifier: LGPL-2.1-or-later
#include <map>
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class SupportsRule : public RuleTest {};

TEST_F(SupportsRule, SupportsByNumberReachCopiesAndNodesBornBetweenThem) {
    std::string cards = "*BOUNDARY\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) cards += std::to_string(node_at(i, j, 0)) + ", 1, 3\n";
    const Mesh mesh = block_with(cards);
    for (const double x : {1.5, 2.0, 2.3}) {
        SCOPED_TRACE(x);
        const Mesh after = crack_at(mesh, x, "CRACK", Vec3(1, .2, .1));
        std::map<Index, std::set<int>> held;
        for (const Row& r : rows(after, "BOUNDARY"))
            for (int dof = std::stoi(r[1]); dof <= std::stoi(r[2]); ++dof)
                EXPECT_TRUE(held[std::stoll(r[0])].insert(dof).second);
        const auto wanted = nodes_where(after, [](const Vec3& p) { return p.z() == 0; });
        EXPECT_GT(wanted.size(), 15u);
        EXPECT_EQ(held.size(), wanted.size());
        for (const Index n : wanted) EXPECT_THAT(held[n], ElementsAre(1, 2, 3)) << n;
    }
}

TEST_F(SupportsRule, SupportsThatASetAndNumbersShareReachNodesBetweenThem) {
    // The set ends at x = 1, numbers go on: an edge between them is held at both ends.
    std::string cards = "*NSET, NSET=LEFT\n", numbers;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
            (i <= 1 ? cards : numbers) += std::to_string(node_at(i, j, 0)) + (i <= 1 ? "\n" : ", 3, 3\n");
    const Mesh after = crack_at(block_with(cards + "*BOUNDARY\nLEFT, 3, 3\n*BOUNDARY\n" + numbers), 1.5);
    std::set<Index> held;
    for (const Row& r : rows(after, "BOUNDARY"))
        for (const Index n : nodes_of(after, r[0])) held.insert(n);
    EXPECT_EQ(held, nodes_where(after, [](const Vec3& p) { return p.z() == 0; }));
}

TEST_F(SupportsRule, PrescribedDisplacementsAreInterpolated) {
    // A rigid rotation about y: u_z = 0.1 x on the bottom, by number, with a value of its own per node.
    std::string cards = "*STEP\n*STATIC\n*BOUNDARY\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
            cards += std::to_string(node_at(i, j, 0)) + ", 3, 3, " + std::to_string(0.1 * i) + "\n";
    const Mesh after = crack_at(block_with(cards + "*END STEP\n"), 1.6);
    std::map<Index, double> value;
    for (const Row& r : rows(after, "BOUNDARY")) value[std::stoll(r[0])] = r.size() > 3 ? std::stod(r[3]) : 0;
    EXPECT_EQ(value.size(), nodes_where(after, [](const Vec3& p) { return p.z() == 0; }).size());
    for (const auto& [node, v] : value) EXPECT_NEAR(v, 0.1 * place(after, node).x(), 1e-12);
}

TEST_F(SupportsRule, MarkNodesThatAreHeldAlike) {
    EXPECT_THAT(marked("*BOUNDARY\n1, 1, 3\n2, 1, 3, .5\n3, 1, 3\nNALL, 1\n*BOUNDARY, OP=MOD\n4, 1, 3\n"),
                ElementsAre(ElementsAre(1, 3, 4), ElementsAre(2)));
    EXPECT_THAT(pinned("*BOUNDARY\n1, 1, 3\n"), IsEmpty());
}

TEST_F(SupportsRule, NodesBornBetweenGetWhatBothEndsHave) {
    const Carried after = carried("*BOUNDARY\n1, 1, 3\n2, 2\n2, 3, 3\n2, 5, 5, .5\n", halve_element_1);
    EXPECT_EQ(after.cards, "*BOUNDARY\n1, 1, 3\n2, 2\n2, 3, 3\n2, 5, 5, .5\n6,2,3\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(SupportsRule, CopiesGetValuesUnlessTheirSetGivesThem) {
    const Carried after = carried("*BOUNDARY\nNALL, 1\n2, 3, 3, .5\n", double_node_2);
    EXPECT_EQ(after.cards, "*BOUNDARY\nNALL, 1\n2, 3, 3, .5\n6,3,3,0.5\n");
}

TEST_F(SupportsRule, RemovedNodesAndLinesThatCannotBeReadAreTold) {
    const Carried after = carried("*BOUNDARY\n1, 1, 3\n5, 1, 3\n2, X\n", remove_element_2);
    EXPECT_EQ(after.cards, "*BOUNDARY\n1, 1, 3\n2, X\n");
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:13: *BOUNDARY: 'X' is no degree of freedom; the line is kept as it is",
                            "deck.inp:12: *BOUNDARY names node 5, which was removed"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
