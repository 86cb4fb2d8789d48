// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;

TEST(InOne, AncestorsPartsAndSharesGoBackToTheFirst) {
    Changes first, second;
    first.born.push_back({100, {1, 2}, {{1, 0.5}, {2, 0.5}}});
    first.parts.push_back({50, 5});
    second.born.push_back({101, {100, 3}, {{100, 0.5}, {3, 0.5}}});
    second.born.push_back({102, {100, 101}, {}});
    second.parts.push_back({51, 50});
    second.parts.push_back({52, 6});
    second.copies.push_back({103, 101});
    const Changes all = in_one(std::vector{first, second});
    ASSERT_EQ(all.born.size(), 3u);
    EXPECT_THAT(all.born[1].ancestors, ElementsAre(1, 2, 3));
    EXPECT_THAT(all.born[1].shares, ElementsAre(std::pair<Index, double>(1, 0.25), std::pair<Index, double>(2, 0.25),
                                                std::pair<Index, double>(3, 0.5)));
    EXPECT_THAT(all.born[2].ancestors, ElementsAre(1, 2, 3));
    EXPECT_TRUE(all.born[2].shares.empty());
    EXPECT_EQ(all.parts[1].parent, 5);
    EXPECT_EQ(all.parts[2].parent, 6);
    EXPECT_EQ(all.copies[0].source, 101);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
