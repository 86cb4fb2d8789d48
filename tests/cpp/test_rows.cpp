// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Rows, GrowOutOfTheirPlace) {
    Rows rows;
    rows.reserve({1, 2});
    rows.add(0, 7);
    rows.add(1, 8);
    rows.add(0, 9);  // moves to the end
    rows.add(1, 10);
    EXPECT_THAT(rows[0], ElementsAre(7, 9));
    EXPECT_THAT(rows[1], ElementsAre(8, 10));
    rows.resize(3);
    EXPECT_THAT(rows[2], IsEmpty());
    rows.add(2, 1);
    EXPECT_THAT(rows[2], ElementsAre(1));
    EXPECT_THAT(rows[0], ElementsAre(7, 9));
}

TEST(Rows, LoseAndChangeEntries) {
    Rows rows;
    rows.resize(2);
    for (const int value : {4, 5, 4, 6}) rows.add(1, value);
    rows.replace(1, 5, 8);
    EXPECT_THAT(rows[1], ElementsAre(4, 8, 4, 6));
    rows.remove(1, 4);
    EXPECT_THAT(rows[1], ElementsAre(8, 6));
    rows.clear(1);
    EXPECT_THAT(rows[1], IsEmpty());
    EXPECT_THAT(rows[0], IsEmpty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
