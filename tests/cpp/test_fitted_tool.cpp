// SPDX-License-Identifier: LGPL-2.1-or-later
// Planes, cylinders and spheres found again in points of them.
#include "deformation/fitted_tool.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tools/cylinder.h"
#include "tools/plane.h"
#include "tools/sphere.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

struct Sample {
    std::vector<Vec3> points, normals;
};

/// Points of a tool near random ones, and about its normals there.
Sample sample(const Tool& tool, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-3, 3), little(-0.03, 0.03);
    Sample out;
    for (int k = 0; k < count; ++k) {
        const Vec3 x = tool.project({at(random), at(random), at(random)});
        out.points.push_back(x);
        out.normals.push_back((tool.normal(x) + Vec3(little(random), little(random), little(random))).normalized());
    }
    return out;
}

void expect_same(const Tool& tool, const char* kind) {
    const Sample s = sample(tool, 40, 7);
    const auto found = fitted_tool(s.points, s.normals, 1e-8, {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind(), kind);
    for (const Vec3& x : sample(tool, 20, 8).points) EXPECT_NEAR(found->distance(x), 0, 1e-7);
}

TEST(FittedTool, FindsWhatThePointsAreOf) {
    expect_same(Plane({1, 2, 3}, {1, 0.4, -2}), "plane");
    expect_same(Cylinder({1, 0.5, 0}, {0.2, 1, 0.5}, 2), "cylinder");
    expect_same(Sphere({1, 0.5, 0}, 4), "sphere");
}

TEST(FittedTool, IsMoved) {
    const Sample s = sample(Cylinder({0, 0, 0}, {0, 0, 1}, 1), 30, 3);
    const auto found = fitted_tool(s.points, s.normals, 1e-8, {2, {5, 0, 0}});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance({7, 0, 1}), 0, 1e-9);
    EXPECT_NEAR(found->distance({5, 2, -1}), 0, 1e-9);
}

TEST(FittedTool, NothingElseAndNotTooFewPoints) {
    Sample s = sample(Cylinder({0, 0, 0}, {0, 0, 1}, 1), 30, 3);
    for (Vec3& x : s.points) x.x() *= 1.001;
    EXPECT_FALSE(fitted_tool(s.points, s.normals, 1e-8, {}));
    const Sample few = sample(Sphere({0, 0, 0}, 1), 6, 3);
    EXPECT_FALSE(fitted_tool(few.points, few.normals, 1e-8, {}));
    EXPECT_FALSE(fitted_tool({}, {}, 1e-8, {}));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
