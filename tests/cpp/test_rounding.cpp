// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "crack_checks.h"
#include "mesh/rounding.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

std::vector<Vec3> random_points(double size, int count = 500) {
    checks::Random random(3);
    std::vector<Vec3> out;
    for (int k = 0; k < count; ++k)
        out.emplace_back(random.uniform(0, size), random.uniform(0, size), random.uniform(0, size));
    return out;
}

std::vector<Vec3> printed(std::vector<Vec3> points, const char* format) {
    for (Vec3& x : points)
        for (int a = 0; a < 3; ++a) {
            char text[64];
            std::snprintf(text, sizeof text, format, x[a]);
            x[a] = std::strtod(text, nullptr);
        }
    return points;
}

TEST(CoordinateRounding, IsNothingInDoublePrecision) { EXPECT_EQ(coordinate_rounding(random_points(7)), 0); }

TEST(CoordinateRounding, IsNothingOnSimpleGrids) {
    std::vector<Vec3> grid;
    for (int i = 0; i <= 12; ++i)
        for (int j = 0; j <= 12; ++j) grid.emplace_back(i * 0.075, j * 0.075, 0);
    EXPECT_EQ(coordinate_rounding(grid), 0);
    for (Vec3& x : grid) x.x() += 6000;  // far from the origin they have more digits, but are no less simple
    EXPECT_EQ(coordinate_rounding(grid), 0);
    EXPECT_EQ(coordinate_rounding({}), 0);
    EXPECT_EQ(coordinate_rounding(std::vector<Vec3>(4, Vec3::Zero())), 0);
}

TEST(CoordinateRounding, IsHalfAUnitOfTheLastSignificantDigit) {
    // The largest are between 1 and 10: six digits end at 1e-5.
    EXPECT_DOUBLE_EQ(coordinate_rounding(printed(random_points(7), "%.5e")), 0.5e-5);
    EXPECT_DOUBLE_EQ(coordinate_rounding(printed(random_points(7), "%.8e")), 0.5e-8);
}

TEST(CoordinateRounding, IsThatOfTheLargestWhereFewAreSoLarge) {
    std::vector<Vec3> points = random_points(9);
    for (int k = 0; k < 8; ++k) points[k].x() = 10.1234567 + 0.013 * k;
    EXPECT_DOUBLE_EQ(coordinate_rounding(printed(points, "%.5e")), 0.5e-4);
}

TEST(CoordinateRounding, IsHalfAUnitOfTheLastDecimal) {
    EXPECT_DOUBLE_EQ(coordinate_rounding(printed(random_points(700), "%.4f")), 0.5e-4);
}

TEST(CoordinateRounding, KnowsSinglePrecision) {
    std::vector<Vec3> points = random_points(7);
    double largest = 0;
    for (Vec3& x : points) {
        x = x.cast<float>().cast<double>();
        largest = std::max(largest, x.maxCoeff());
    }
    EXPECT_DOUBLE_EQ(coordinate_rounding(points), std::ldexp(largest, -24));
}

TEST(CoordinateRounding, IsSeenAmongNewNodesInDoublePrecision) {
    std::vector<Vec3> points = printed(random_points(7), "%.5e");
    for (const Vec3& x : random_points(6.9, 1500)) points.push_back(x);
    EXPECT_DOUBLE_EQ(coordinate_rounding(points), 0.5e-5);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
