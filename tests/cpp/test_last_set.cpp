// SPDX-License-Identifier: LGPL-2.1-or-later
// Sets without members that CalculiX would forget. (That it does not is tested in tests/python/test_emptied_sets.py.)
#include "io/last_set.h"

#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using enum DeckSetType;

TEST(DefinedSets, NeedNothingWhereAllHaveMembers) {
    DefinedSets sets;
    EXPECT_FALSE(sets.needs_last_set());
    sets.add(nset, "A", true, true);
    sets.add(elset, "B", true, false);
    sets.add(element_surface, "C", true, false);
    EXPECT_FALSE(sets.needs_last_set());
}

TEST(DefinedSets, AreForgottenWhereTheLastOneHasNoEnd) {
    DefinedSets sets;
    sets.add(elset, "B", true, false);
    sets.add(elset, "C", false, true);
    EXPECT_FALSE(sets.needs_last_set()) << "no surface is read behind it";
    sets.add(element_surface, "A", true, false);
    EXPECT_TRUE(sets.needs_last_set());
    sets.add(nset, "D", true, false);
    EXPECT_FALSE(sets.needs_last_set()) << "another is the last";
    sets.add(element_surface, "E", false, false);
    EXPECT_TRUE(sets.needs_last_set()) << "a surface without lines";
}

TEST(DefinedSets, HaveAnEndBehindMembersOfOthers) {
    DefinedSets sets;
    sets.add(element_surface, "A", true, false);
    sets.add(elset, "E", false, true);
    sets.add(nset, "B", true, true);  // *NODE is read before *ELEMENT
    EXPECT_FALSE(sets.needs_last_set());
    DefinedSets late;
    late.add(element_surface, "A", true, false);
    late.add(elset, "E", false, true);
    late.add(elset, "B", true, true);
    EXPECT_TRUE(late.needs_last_set()) << "the one without members is read first";
}

TEST(DefinedSets, AreSortedAsCalculixDoes) {
    DefinedSets sets;
    sets.add(element_surface, "surf a", false, false);
    sets.add(nset, "SURFA", true, true);  // SURFAN is before SURFAT
    EXPECT_TRUE(sets.needs_last_set());
    sets.add(nset, "SURFA_1", true, true);
    EXPECT_FALSE(sets.needs_last_set());
}

TEST(LastSet, IsTakenOutOfTheDeck) {
    Card node, last;
    node.set_text("*NODE, NSET=N\n1, 0., 0., 0.\n");
    last.set_text(last_set_card("1, 0., 0., 0.", "\r\n"));
    EXPECT_EQ(last.keyword, "NODE");
    EXPECT_TRUE(last.text.front().text.ends_with("\r\n1, 0., 0., 0.\r\n"));
    DefinedSets sets;
    sets.add(element_surface, "ZZZ", false, false);
    sets.add(nset, *last.parameter("NSET"), true, true);
    EXPECT_FALSE(sets.needs_last_set());
    std::vector<Card> cards{last, node};
    EXPECT_TRUE(remove_last_set(cards));
    EXPECT_FALSE(remove_last_set(cards));
    ASSERT_EQ(cards.size(), 1u);
    EXPECT_EQ(*cards[0].parameter("NSET"), "N");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
