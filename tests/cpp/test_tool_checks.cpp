// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "error.h"
#include "tools/axis_frame.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using Eigen::Vector3d;
using testing::StrEq;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Call>
void expect_error(Call call, const char* message) {
    EXPECT_THAT(call, testing::ThrowsMessage<ToolError>(StrEq(message)));
    try {
        call();
    } catch (const ToolError& e) {
        EXPECT_NE(std::string(message).find(": " + std::string(e.parameter()) + " "), std::string::npos)
            << "the error is about " << e.parameter();
    }
}

TEST(CheckedPoint, MustBeFinite) {
    EXPECT_EQ(checked_point({1, 2, 3}, {"disk", "center"}), Vector3d(1, 2, 3));
    expect_error(
        [] {
            checked_point({1, std::nan(""), 3}, {"disk", "center"});
        },
        "disk: center has a value that is not a finite number");
}

TEST(CheckedDirection, IsScaledToUnitLength) {
    EXPECT_EQ(checked_direction({0, -3, 0}, {"plane", "normal"}), Vector3d(0, -1, 0));
    EXPECT_LT((checked_direction({3e-200, 4e-200, 0}, {"plane", "normal"}) - Vector3d(0.6, 0.8, 0)).norm(), 1e-15)
        << "its square is too small a number";
    expect_error(
        [] {
            checked_direction({0, 0, 0}, {"plane", "normal"});
        },
        "plane: normal is the zero vector; give a direction");
    expect_error(
        [] {
            checked_direction({0, infinity, 0}, {"plane", "normal"});
        },
        "plane: normal has a value that is not a finite number");
}

TEST(CheckedLength, MustBePositiveAndFinite) {
    EXPECT_EQ(checked_length(0.25, {"sphere", "radius"}), 0.25);
    expect_error([] { checked_length(0, {"sphere", "radius"}); }, "sphere: radius is 0; it must be positive");
    expect_error([] { checked_length(-1.5, {"sphere", "radius"}); }, "sphere: radius is -1.5; it must be positive");
    expect_error([] { checked_length(infinity, {"sphere", "radius"}); }, "sphere: radius is not a finite number");
}

TEST(AxisFrame, SeesAPointFromAnAxis) {
    const AxisFrame frame({4, 6, 9}, {1, 2, 3}, {0, 0, 1});
    EXPECT_EQ(frame.height, 6);
    EXPECT_EQ(frame.radius, 5);
    EXPECT_LT((frame.outward - Vector3d(0.6, 0.8, 0)).norm(), 1e-15);
    const AxisFrame on({1, 2, 9}, {1, 2, 3}, {0, 0, 1});
    EXPECT_EQ(on.radius, 0);
    EXPECT_NEAR(on.outward.norm(), 1, 1e-15);
    EXPECT_EQ(on.outward.z(), 0);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
