// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/closest_point.h"

#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

/// The right triangle with legs of 4 in z = 0: where the nearest point is, and its barycentric coordinates.
struct Case {
    Vec3 from, at, bary;
};

TEST(ClosestOnTriangle, IsInsideOnAnEdgeOrACorner) {
    const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
    for (const Case& k : {Case{{1, 1, 5}, {1, 1, 0}, {0.5, 0.25, 0.25}}, Case{{-1, -2, 3}, {0, 0, 0}, {1, 0, 0}},
                          Case{{7, -1, 0}, {4, 0, 0}, {0, 1, 0}}, Case{{-1, 6, 1}, {0, 4, 0}, {0, 0, 1}},
                          Case{{1, -2, 1}, {1, 0, 0}, {0.75, 0.25, 0}}, Case{{-3, 3, 2}, {0, 3, 0}, {0.25, 0, 0.75}},
                          Case{{4, 2, 1}, {3, 1, 0}, {0, 0.75, 0.25}}}) {
        Vec3 bary;
        EXPECT_LT((closest_on_triangle(a, b, c, k.from, bary) - k.at).norm(), 1e-15) << k.from.transpose();
        EXPECT_LT((bary - k.bary).norm(), 1e-15) << k.from.transpose();
    }
}

TEST(ClosestOnSegment, IsBetweenOrAnEnd) {
    const Vec3 a(1, 0, 0), b(3, 0, 0);
    EXPECT_EQ(closest_on_segment(a, b, {2.5, 7, 0}), Vec3(2.5, 0, 0));
    EXPECT_EQ(closest_on_segment(a, b, {0, 7, 0}), a);
    EXPECT_EQ(closest_on_segment(a, b, {9, 7, 0}), b);
    EXPECT_EQ(closest_on_segment(a, a, {9, 7, 0}), a);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
