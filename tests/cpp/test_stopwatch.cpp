// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/stopwatch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::Pair;

TEST(Laps, AddUpByName) {
    Laps laps;
    laps.add("snap", 1);
    laps.add("split", 2);
    laps.add("snap", 4);
    EXPECT_THAT(laps.list(), ElementsAre(Pair("snap", 5), Pair("split", 2)));
    EXPECT_EQ(laps.sum(), 7);
    Laps copy = laps;
    copy.add("open", 8);
    EXPECT_EQ(laps.sum(), 15) << "copies are the same list";
}

TEST(Stopwatch, GivesPartsTheirNames) {
    using std::chrono::seconds;
    Laps laps, parts;
    parts.add("inside", 30);
    Stopwatch watch(laps, Stopwatch::now() - seconds(100));
    watch.lap("cut", parts);
    ASSERT_EQ(laps.list().size(), 2u);
    EXPECT_THAT(laps.list()[0], Pair("inside", 30));
    EXPECT_EQ(laps.list()[1].first, "cut");
    EXPECT_NEAR(laps.list()[1].second, 70, 5);
    watch.lap("next");
    EXPECT_LT(laps.list()[2].second, 5) << "from the last lap on";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
