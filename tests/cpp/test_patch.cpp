// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "error.h"
#include "tools/cylinder.h"
#include "tools/elliptic_cylinder.h"
#include "tools/plane.h"
#include "tools/sphere.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using Eigen::Vector3d;
using testing::HasSubstr;

const Plane plane({0, 0, 2}, {0, 0, 1});
const Sphere ball({0, 0, 0}, 1);

template <class Call>
void expect_error(Call call, const char* part) {
    EXPECT_THAT(call, testing::ThrowsMessage<ToolError>(HasSubstr(part)));
}

TEST(Disk, IsBoundedByACircle) {
    const Patch patch = Disk({1, 0, 2}, 3).on(plane);
    EXPECT_EQ(patch.sides.size(), 1u);
    EXPECT_EQ(patch.feature_size, 3);
    EXPECT_EQ(patch.distance({1, 0, 2}), -3);
    EXPECT_EQ(patch.distance({1, 4, 2}), 1);
    EXPECT_EQ(patch.side({1, 4, 2}), 0);
    EXPECT_TRUE(patch.corners.empty());
    EXPECT_TRUE(patch.has(patch.sides[0].get()));
    EXPECT_FALSE(patch.has(&plane));
    expect_error([] { Disk({0, 0, 2}, -1); }, "disk: radius is -1");
    expect_error([] { Disk({0, 0, 2}, 1).on(ball); }, "a disk lies in a plane, but the tool is a sphere");
    expect_error([] { Disk({0, 0, 2.5}, 1).on(plane); }, "the disk's center is off the plane by 0.5");
}

TEST(Ellipse, HasTwoHalfAxes) {
    const Patch patch = Ellipse({0, 0, 2}, 3, 1, {1, 0, 0.5}).on(plane);  // its direction within the plane
    EXPECT_EQ(patch.feature_size, 1);
    EXPECT_NEAR(patch.distance({4, 0, 2}), 1, 1e-12);
    EXPECT_NEAR(patch.distance({0, 2.5, 2}), 1.5, 1e-12);
    EXPECT_LT(patch.distance({2, 0.5, 2}), 0);
    expect_error([] { Ellipse({0, 0, 2}, 3, 1, {0, 0, 1}).on(plane); }, "is normal to the plane");
    expect_error([] { Ellipse({0, 0, 2}, 3, 0, {1, 0, 0}); }, "second half axis");
}

TEST(EllipticCylinder, MeasuresTheDistanceToItsWall) {
    const EllipticCylinder tool({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 3, 2);
    EXPECT_EQ(tool.kind(), "elliptic cylinder");
    EXPECT_NEAR(tool.feature_size(), 4.0 / 3, 1e-12) << "where it is most curved: b^2 / a";
    EXPECT_NEAR(tool.distance({5, 0, 7}), 2, 1e-12);
    EXPECT_NEAR(tool.distance({0, 1, 7}), -1, 1e-12);
    // Along the normal of some point of it.
    const double t = 0.7;
    const Vector3d foot(3 * std::cos(t), 2 * std::sin(t), 0);
    const Vector3d normal = Vector3d(std::cos(t) / 3, std::sin(t) / 2, 0).normalized();
    for (const double off : {0.5, -0.4}) {
        EXPECT_NEAR(tool.distance(foot + off * normal), off, 1e-12);
        EXPECT_LT((tool.normal(foot + off * normal) - normal).norm(), 1e-10);
    }
}

TEST(HalfPlane, IsOnTheSideOfItsDirection) {
    const Patch patch = HalfPlane({1, 0, 2}, {2, 0, 0}).on(plane);
    EXPECT_EQ(patch.distance({4, 7, 2}), -3);
    EXPECT_EQ(patch.distance({-1, 7, 2}), 2);
    EXPECT_EQ(patch.feature_size, std::numeric_limits<double>::infinity());
    expect_error([] { HalfPlane({1, 0, 2}, {0, 0, 0}); }, "half plane: direction is the zero vector");
}

/// An L, which is not convex: 4 long and wide, 1 thick.
Polygon l_shape() { return Polygon({{0, 0, 2}, {4, 0, 2}, {4, 1, 2}, {1, 1, 2}, {1, 4, 2}, {0, 4, 2}}); }

TEST(Polygon, NeedNotBeConvex) {
    const Patch patch = l_shape().on(plane);
    ASSERT_EQ(patch.sides.size(), 6u);
    ASSERT_EQ(patch.corners.size(), 6u);
    EXPECT_NEAR(patch.feature_size, 0.5, 1e-12);
    EXPECT_NEAR(patch.distance({0.5, 3, 2}), -0.5, 1e-12);
    EXPECT_NEAR(patch.distance({2, 2, 2}), 1, 1e-12) << "in the notch";
    EXPECT_NEAR(patch.distance({7, -4, 2}), 5, 1e-12) << "from a corner";
    const Tool& nearest = *patch.sides[patch.side({2.5, 1.1, 2})];
    EXPECT_NEAR(nearest.distance({2.5, 1, 2}), 0, 1e-12);
    EXPECT_NEAR(nearest.distance({2.5, 2, 2}), 1, 1e-12) << "sides look outwards";
    for (const Patch::Corner& c : patch.corners)
        for (const int side : c.sides) EXPECT_NEAR(patch.sides[side]->distance(c.at), 0, 1e-12);
}

TEST(Polygon, RefusesWhatIsNone) {
    expect_error([] { Polygon({{0, 0, 2}, {1, 0, 2}}); }, "2 corners; give");
    expect_error([] { Polygon({{0, 0, 2}, {0, 0, 2}, {1, 0, 2}}); }, "corner 1 is repeated");
    expect_error([] { Polygon({{0, 0, 2}, {1, 1, 2}, {1, 0, 2}, {0, 1, 2}}).on(plane); }, "sides 1 and 3 cross");
    expect_error([] { Polygon({{0, 0, 2}, {1, 0, 2}, {0, 1, 3}}).on(plane); }, "corner 3 of the polygon is off");
}

TEST(CylinderPart, EndsAlongTheAxisAndAround) {
    const Cylinder cylinder({0, 0, 1}, {0, 0, 1}, 2);
    const Patch ring = CylinderPart(0, 6).on(cylinder);
    EXPECT_EQ(ring.sides.size(), 2u);
    EXPECT_EQ(ring.feature_size, 3);
    EXPECT_NEAR(ring.distance({2, 0, 2}), -1, 1e-12);
    EXPECT_NEAR(ring.distance({2, 0, 8}), 1, 1e-12);
    EXPECT_EQ(ring.side({2, 0, 2}), 0);
    EXPECT_EQ(ring.side({2, 0, 6}), 1);
    const Patch part = CylinderPart(0, 6, CylinderPart::Angles{-90, 90, {1, 0, 0}}).on(cylinder);
    ASSERT_EQ(part.sides.size(), 4u);
    EXPECT_EQ(part.corners.size(), 4u);
    EXPECT_NEAR(part.feature_size, 3, 1e-12);
    EXPECT_NEAR(part.distance({2, 0, 4}), -3, 1e-12);
    EXPECT_NEAR(part.distance({-2, 0, 4}), std::numbers::pi, 1e-12) << "along the circle";
    EXPECT_EQ(part.side({0.1, 2, 4}), 3);
    EXPECT_EQ(part.side({0.1, -2, 4}), 2);
    for (const Patch::Corner& c : part.corners) {
        EXPECT_NEAR(cylinder.distance(c.at), 0, 1e-12);
        for (const int side : c.sides) EXPECT_NEAR(part.sides[side]->distance(c.at), 0, 1e-12);
    }
    expect_error([] { CylinderPart(0, 1).on(plane); }, "a cylinder part lies on a cylinder, but the tool is a plane");
    expect_error([] { CylinderPart(1, 1); }, "along must go from one place to another");
    expect_error([] { CylinderPart(0, 1, CylinderPart::Angles{0, 360, {1, 0, 0}}); }, "less than 360 degrees");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
