// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/coordinate_slack.h"

#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(CoordinateSlack, IsNothingWhereCoordinatesWereNotRounded) {
    const CoordinateSlack slack(checks::grid(3, 3, 3));
    EXPECT_EQ(slack.off(), 0);
    EXPECT_EQ(slack.direction(1e-6), 0);
    EXPECT_EQ(slack.normal({0, 0, 0}, {1, 0, 0}, {0, 1e-9, 0}), 0);
}

TEST(CoordinateSlack, OfNormalsGoesByTheSmallestHeight) {
    const CoordinateSlack slack(1e-5);
    EXPECT_DOUBLE_EQ(slack.direction(4), 5e-6);
    // Three units long, one high.
    EXPECT_DOUBLE_EQ(slack.normal({0, 0, 0}, {3, 0, 0}, {1, 1, 0}), 2e-5);
    EXPECT_DOUBLE_EQ(slack.normal({0, 0, 0}, {3, 0, 0}, {1, 0.1, 0}), 2e-4);
    EXPECT_DOUBLE_EQ(slack.normal({0, 0, 0}, {3, 0, 0}, {1, 1e-7, 0}), 0.5);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
