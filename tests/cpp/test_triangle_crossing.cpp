// SPDX-License-Identifier: LGPL-2.1-or-later
// The segment in which two triangles cross.
#include "mesh/triangle_crossing.h"

#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

constexpr double tolerance = 1e-6;
const TriangleCorners floor_{Vec3(-2, -2, 0), Vec3(4, -2, 0), Vec3(-2, 4, 0)};

double length(const Span& s) { return (s[1] - s[0]).norm(); }

TEST(CrossTriangles, OfOneThroughTheOther) {
    const auto span = cross_triangles(floor_, {Vec3(0, 0, -1), Vec3(1, 0, -1), Vec3(0.5, 0, 1)}, tolerance);
    ASSERT_TRUE(span);
    EXPECT_NEAR(length(*span), 0.5, 1e-12);
    EXPECT_NEAR((*span)[0][2], 0, 1e-12);
}

TEST(CrossTriangles, OfOneThatStandsOnTheOtherItsEdge) {
    const Vec3 a(0, 0, 1e-8), b(1, 0.2, -1e-8);
    const auto span = cross_triangles(floor_, {a, b, Vec3(0.5, 0, 1)}, tolerance);
    ASSERT_TRUE(span);
    // As it is, bit by bit.
    EXPECT_TRUE(((*span)[0] == a && (*span)[1] == b) || ((*span)[0] == b && (*span)[1] == a));
}

TEST(CrossTriangles, EndsAtTheOthersBorder) {
    const auto span = cross_triangles(floor_, {Vec3(-3, 0, -1), Vec3(9, 0, -1), Vec3(3, 0, 5)}, tolerance);
    ASSERT_TRUE(span);
    EXPECT_NEAR(length(*span), 4, 1e-12);  // from x = -2 to x = 2
}

TEST(CrossTriangles, IsNothingForATouchingCornerOneApartOrOneInThePlane) {
    EXPECT_FALSE(cross_triangles(floor_, {Vec3(0, 0, 0), Vec3(1, 0, 1), Vec3(0, 1, 1)}, tolerance));
    EXPECT_FALSE(cross_triangles(floor_, {Vec3(0, 0, 1), Vec3(1, 0, 2), Vec3(0, 1, 2)}, tolerance));
    EXPECT_FALSE(cross_triangles(floor_, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, tolerance));
    EXPECT_FALSE(cross_triangles(floor_, {Vec3(9, 0, -1), Vec3(9, 1, -1), Vec3(9, 0.5, 1)}, tolerance));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
