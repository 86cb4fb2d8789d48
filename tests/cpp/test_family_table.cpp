// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/family_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "groups/family_sets.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;

struct FamilyTableTest : testing::Test {
    FamilyIndex family(std::vector<GroupIndex> groups) { return table.intern(groups); }
    FamilyTable table;
    FamilyIndex none = 0, a = family({0}), ab = family({0, 1}), bc = family({1, 2});
};

TEST_F(FamilyTableTest, KeepsEachSetOnce) {
    EXPECT_EQ(table.size(), 4);
    EXPECT_EQ(family({0, 1}), ab);
    EXPECT_EQ(family({}), none);
    EXPECT_EQ(table.size(), 4);
    EXPECT_THAT(table.groups(bc), ElementsAre(1, 2));
    EXPECT_THAT(table.groups(none), IsEmpty());
    EXPECT_TRUE(table.contains(bc, 2));
    EXPECT_FALSE(table.contains(ab, 2));
    EXPECT_FALSE(table.contains(none, 0));
}

TEST_F(FamilyTableTest, MakesSetsOfSets) {
    EXPECT_EQ(table.with(a, 1), ab);
    EXPECT_EQ(table.with(ab, 0), ab);
    EXPECT_THAT(table.groups(table.with(bc, 0)), ElementsAre(0, 1, 2));
    EXPECT_EQ(table.without(ab, 1), a);
    EXPECT_EQ(table.without(a, 0), none);
    EXPECT_EQ(table.without(a, 5), a);
    EXPECT_THAT(table.groups(table.unite(ab, bc)), ElementsAre(0, 1, 2));
    EXPECT_THAT(table.groups(table.intersect(ab, bc)), ElementsAre(1));
    EXPECT_EQ(table.intersect(a, bc), none);
}

TEST_F(FamilyTableTest, OperationsOfFamilySetsAreTheSame) {
    FamilySets sets(table);
    for (int round = 0; round < 2; ++round) {  // the second from what the first kept
        EXPECT_THAT(table.groups(sets.both(ab, bc)), ElementsAre(1));
        EXPECT_THAT(table.groups(sets.either(ab, bc)), ElementsAre(0, 1, 2));
        EXPECT_THAT(table.groups(sets.minus(ab, bc)), ElementsAre(0));
        EXPECT_THAT(table.groups(sets.minus(bc, ab)), ElementsAre(2)) << "not the same as the other way round";
        EXPECT_THAT(table.groups(sets.differ(ab, bc)), ElementsAre(0, 2));
    }
    EXPECT_EQ(sets.both(ab, none), none);
    EXPECT_EQ(sets.both(ab, ab), ab);
    EXPECT_EQ(sets.either(none, ab), ab);
    EXPECT_EQ(sets.minus(ab, ab), none);
    EXPECT_EQ(sets.minus(ab, none), ab);
    EXPECT_EQ(sets.minus(none, ab), none);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
