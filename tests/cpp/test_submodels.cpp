// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class SubmodelsRule : public RuleTest {};

TEST_F(SubmodelsRule, SubmodelNodesIncludeNewOnes) {
    std::string numbers;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) numbers += std::to_string(node_at(i, j, 0)) + (i < nx || j < ny ? ",\n" : "\n");
    const Mesh after = crack_at(block_with("*SUBMODEL, TYPE=NODE, INPUT=global.frd\n" + numbers), 1.5);
    std::set<Index> listed;
    for (const Row& r : rows(after, "SUBMODEL")) listed.insert(std::stoll(r[0]));
    EXPECT_EQ(listed, nodes_where(after, [](const Vec3& p) { return p.z() == 0; }));
}

TEST_F(SubmodelsRule, NodesBornBetweenListedOnesAreListed) {
    const Carried after = carried("*SUBMODEL, TYPE=NODE, INPUT=global.frd\n1,\n2,\n", halve_element_1);
    EXPECT_EQ(after.cards, "*SUBMODEL, TYPE=NODE, INPUT=global.frd\n1,\n2,\n6,\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(SubmodelsRule, SurfacesAreNoNodes) {
    const std::string cards =
        "*SURFACE, NAME=S\n1, S1\n*SUBMODEL, TYPE=SURFACE, INPUT=global.frd\nS\n*CLOAD\n1, 1, 1.\n";
    const Carried after = carried(cards, double_node_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(SubmodelsRule, RemovedNodesAreTold) {
    const Carried after = carried("*SUBMODEL, TYPE=NODE, INPUT=global.frd\n1,\n5,\n", remove_element_2);
    EXPECT_EQ(after.cards, "*SUBMODEL, TYPE=NODE, INPUT=global.frd\n1,\n");
    EXPECT_THAT(after.warnings, ElementsAre("deck.inp:12: *SUBMODEL names node 5, which was removed"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
