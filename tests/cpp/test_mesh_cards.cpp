// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

class MeshCardsRule : public RuleTest {};

TEST_F(MeshCardsRule, OtherElementsKeepTheirNodesAndAreReported) {
    const std::string node = std::to_string(node_at(2, 1, 2));
    const Mesh mesh = block_with(
        "*USER ELEMENT, TYPE=US3, NODES=2, INTEGRATION POINTS=1, MAXDOF=3\n*ELEMENT, TYPE=US3, ELSET=U\n500, " + node +
        ", 1\n");
    ASSERT_EQ(solver_input(mesh)->other_elements().size(), 1u);
    crack_at(mesh, 2);
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr("node " + node), HasSubstr("element 500 of type US3"))));
}

const std::string user =
    "*USER ELEMENT, TYPE=US3, NODES=2, INTEGRATION POINTS=1, MAXDOF=3\n*ELEMENT, TYPE=US3, ELSET=U\n500, ";

TEST_F(MeshCardsRule, NodesOfElementsOutsideTheMeshArePinned) {
    EXPECT_THAT(pinned(user + "5, 1\n"), ElementsAre(1, 5));
}

TEST_F(MeshCardsRule, ElementsOutsideTheMeshStayWithTheOriginals) {
    EXPECT_THAT(carried(user + "5, 1\n", double_node_2).warnings, IsEmpty());
    EXPECT_THAT(
        carried(user + "5, 2\n", double_node_2).warnings,
        ElementsAre(
            "deck.inp:11: *ELEMENT names node 2, which the crack doubled; element 500 of type US3 stays with the "
            "original, on the negative side"));
}

TEST_F(MeshCardsRule, ElementsOutsideTheMeshMustKeepTheirNodes) {
    EXPECT_THAT(
        [&] { carried(user + "5, 1\n", remove_element_2); },
        testing::ThrowsMessage<Error>(testing::EndsWith(
            "deck.inp:11: element 500 of type US3 needs node 5, which would be removed, and cannot be removed itself. "
            "Move the tool, or take the element out of the deck")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
