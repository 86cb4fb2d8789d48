// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/entity_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;

TEST(EntityTable, KeepsEachEntityOnceInAnyOrderOfItsNodes) {
    EntityTable<4> faces;
    EXPECT_EQ(faces.find({3, 1, 2, -1}), nullptr);
    faces.insert({3, 1, 2, -1}).areas = 1;
    faces.insert({1, 2, 3, 4}).belongs = true;
    EXPECT_EQ(faces.insert({2, 3, 1, -1}).areas, 1);
    ASSERT_EQ(faces.entries().size(), 2u);
    EXPECT_THAT(faces.entries()[0].nodes(), ElementsAre(3, 1, 2, -1)) << "as first given";
    EXPECT_TRUE(faces.find({4, 3, 2, 1})->belongs);
    EXPECT_EQ(faces.find({1, 2, 4, -1}), nullptr);
    faces.find({1, 2, 3, -1})->turn({1, 2, 3, -1});
    EXPECT_THAT(faces.entries()[0].nodes(), ElementsAre(1, 2, 3, -1));
    EXPECT_EQ(faces.find({3, 1, 2, -1}), &faces.entries()[0]) << "it is found as before";
}

TEST(EntityTable, FindsAllWhenItGrew) {
    EntityTable<2> edges;
    for (Index k = 0; k < 1000; ++k) edges.insert({k, 1000 + k * k % 997}).apex = static_cast<std::uint32_t>(k);
    ASSERT_EQ(edges.entries().size(), 1000u);
    for (Index k = 0; k < 1000; ++k) {
        const auto* found = edges.find({1000 + k * k % 997, k});
        ASSERT_NE(found, nullptr);
        EXPECT_EQ(found->apex, k);
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
