// SPDX-License-Identifier: LGPL-2.1-or-later
// Tools against what defines them: the normal is the gradient of the distance, the projection lies on the surface.
#include <gtest/gtest.h>

#include <cmath>

#include "crack_checks.h"
#include "error.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace femscalpel {
namespace {

/// Compares normal() with differences of distance(), and looks at project(), at random points around the origin.
void expect_consistent(const Tool& tool, double reach) {
    checks::Random random(11);
    for (int k = 0; k < 1000; ++k) {
        const Vec3 x = reach * random.uniform() * random.direction();
        const double distance = tool.distance(x);
        const Vec3 normal = tool.normal(x);
        EXPECT_NEAR(normal.norm(), 1, 1e-12);
        const Vec3 foot = tool.project(x);
        EXPECT_NEAR(tool.distance(foot), 0, 1e-12 * reach) << x.transpose();
        EXPECT_NEAR((x - foot).norm(), std::abs(distance), 1e-9 * reach) << x.transpose();
        const double step = 1e-6 * reach;
        if (std::abs(distance) < 10 * step) continue;
        for (int a = 0; a < 3; ++a) {
            const double slope = (tool.distance(x + step * Vec3::Unit(a)) - tool.distance(x - step * Vec3::Unit(a))) / (2 * step);
            EXPECT_NEAR(slope, normal[a], 1e-4) << x.transpose();
        }
    }
}

TEST(Tools, Plane) {
    expect_consistent(Plane({0.1, 0.2, 0.3}, {1, -2, 0.5}), 2);
    EXPECT_DOUBLE_EQ(Plane({0, 0, 1}, {0, 0, 9}).distance({5, 5, 3}), 2);
}

TEST(Tools, Cylinder) {
    const Cylinder cylinder({0.1, 0.2, 0.3}, {1, -2, 0.5}, 0.7);
    expect_consistent(cylinder, 2);
    EXPECT_DOUBLE_EQ(cylinder.feature_size(), 0.7);
    const Cylinder upright({1, 1, 0}, {0, 0, 2}, 2);
    EXPECT_DOUBLE_EQ(upright.distance({1, 1, 7}), -2);
    EXPECT_DOUBLE_EQ(upright.distance({1, 4, -7}), 1);
    EXPECT_NEAR(upright.normal({1, 1, 7}).dot(Vec3::UnitZ()), 0, 1e-15) << "on the axis";
    EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 0}, 1), ToolError);
    EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 1}, 0), ToolError);
    EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 1}, -1), ToolError);
    EXPECT_THROW(Cylinder({0, 0, 0}, {0, 0, 1}, std::nan("")), ToolError);
    EXPECT_THROW(Cylinder({0, 0, INFINITY}, {0, 0, 1}, 1), ToolError);
}

}  // namespace
}  // namespace femscalpel
