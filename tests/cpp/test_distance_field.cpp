// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/distance_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "error.h"
#include "tools/plane.h"
#include "tools/sphere.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using Eigen::Vector3d;
using testing::HasSubstr;

TEST(DistanceTo, TheNearestTool) {
    const Plane plane({0, 0, 0}, {0, 0, 1});
    const Sphere sphere({0, 0, 5}, 1);
    const DistanceField field = distance_to(std::vector<const Tool*>{&plane, &sphere});
    EXPECT_EQ(field({0, 0, -2}), -2) << "signed";
    EXPECT_EQ(field({0, 0, 1}), 1);
    EXPECT_EQ(field({0, 0, 3.5}), 0.5);
    EXPECT_EQ(field({0, 0, 4.25}), -0.25) << "inside the sphere";
    const Sphere around({0, 0, 5}, 10);
    EXPECT_EQ(distance_to(std::vector<const Tool*>{&plane, &around})({0, 0, 0.25}), 0.25) << "not deep inside";
    EXPECT_THAT([] { distance_to(std::vector<const Tool*>()); },
                testing::ThrowsMessage<ToolError>(HasSubstr("near is empty")));
}

TEST(DistanceTo, TheNearestPoint) {
    const DistanceField field = distance_to(std::vector<Vector3d>{{0, 0, 0}, {10, 0, 0}});
    EXPECT_EQ(field({3, 4, 0}), 5);
    EXPECT_EQ(field({7, 4, 0}), 5);
    EXPECT_EQ(field({10, 0, 0}), 0);
    EXPECT_THAT([] { distance_to(std::vector<Vector3d>()); },
                testing::ThrowsMessage<ToolError>(HasSubstr("near is empty")));
    const std::vector<Vector3d> bad{{0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}};
    EXPECT_THAT([&] { distance_to(bad); }, testing::ThrowsMessage<ToolError>(HasSubstr("near: point 1 has a value")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
