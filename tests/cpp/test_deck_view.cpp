// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/deck_view.h"

#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace rule_testing;

class DeckViewTest : public RuleTest {};

TEST_F(DeckViewTest, NumbersSteps) {
    const Mesh mesh = two_tetras(
        "*MATERIAL, NAME=M\n*STEP\n*STATIC\n*END STEP\n*AMPLITUDE, NAME=A\n0., 1.\n*STEP\n*STATIC\n*CLOAD\n1, 1, 1.\n");
    const DeckView view(mesh);
    std::vector<std::pair<std::string, int>> steps;
    for (std::size_t c = 0; c < view.cards().size(); ++c)
        if (view.cards()[c].keyword != "NODE" && view.cards()[c].keyword != "ELEMENT")
            steps.emplace_back(view.cards()[c].keyword, view.step(c));
    EXPECT_THAT(steps, ElementsAre(Pair("MATERIAL", 0), Pair("STEP", 1), Pair("STATIC", 1), Pair("ENDSTEP", 1),
                                   Pair("AMPLITUDE", 0), Pair("STEP", 2), Pair("STATIC", 2), Pair("CLOAD", 2)));
}

TEST_F(DeckViewTest, FindsGroupsOfSets) {
    const Mesh mesh = two_tetras("*NSET, NSET=Ends\n1, 5\n*ELSET, ELSET=ENDS\n2\n");
    const DeckView view(mesh);
    const auto nodes = view.group(DeckSetType::nset, "ENDS"), elements = view.group(DeckSetType::elset, "ends");
    ASSERT_TRUE(nodes && elements);
    EXPECT_NE(*nodes, *elements);
    EXPECT_THAT(view.members(*nodes), ElementsAre(1, 5));
    EXPECT_THAT(view.members(*elements), ElementsAre(2));
    EXPECT_TRUE(view.has_node(*nodes, 4));
    EXPECT_FALSE(view.has_node(*nodes, 1));
    EXPECT_EQ(view.group(DeckSetType::nset, "MIDDLE"), std::nullopt);
    EXPECT_EQ(view.numbers().node(5), 4);
    EXPECT_FALSE(view.is_plane({CellType::tetra, 0}));
}

TEST(DeckLines, AreReadAsNumbersOrSets) {
    Card card;
    card.set_text("*CLOAD\n, 3\n7, 1, 2.\nENDS, , 4, LAST\n");
    CardReader line(card);
    const auto first = next_entry(line);
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->is_number());
    EXPECT_EQ(first->number, 7) << "a line whose first entry is empty is passed over";
    const auto second = next_entry(line);
    ASSERT_TRUE(second);
    EXPECT_FALSE(second->is_number());
    EXPECT_EQ(second->set, "ENDS");
    const std::vector<NumberOrSet> rest = read_entries(line);
    ASSERT_EQ(rest.size(), 2u);
    EXPECT_EQ(rest[0].number, 4);
    EXPECT_EQ(rest[1].set, "LAST");
    EXPECT_FALSE(next_entry(line));
}

TEST(DeckCards, AreEqualButForOp) {
    const auto key = [](const char* text) {
        Card card;
        card.set_text(text);
        return parameters_key(card);
    };
    EXPECT_EQ(key("*BOUNDARY, OP=NEW, AMPLITUDE=a b\n"), key("*boundary, AMPLITUDE=AB\n"));
    EXPECT_NE(key("*BOUNDARY, AMPLITUDE=A\n"), key("*BOUNDARY, AMPLITUDE=B\n"));
    Card typed;
    typed.set_text("*INITIAL CONDITIONS, TYPE=plastic strain\n");
    EXPECT_EQ(type_of(typed), "PLASTICSTRAIN");
    typed.set_text("*INITIAL CONDITIONS\n");
    EXPECT_EQ(type_of(typed), "");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
