// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/inp_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace femscalpel {
namespace FILE_NAMESPACE {

std::string coordinate(double value) {
    std::string out = "x";
    append_coordinate(out, value);
    return out.substr(1);
}

TEST(AppendCoordinate, WritesTheShortestThatIsExact) {
    EXPECT_EQ(coordinate(0.5), "0.5");
    EXPECT_EQ(coordinate(-12), "-12");
    EXPECT_EQ(coordinate(0.1), "0.1");
    EXPECT_EQ(coordinate(1e-30), "1e-30");
}

TEST(AppendCoordinate, FitsTwentyCharactersAndIsAsCloseAsThatAllows) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> mantissa(1, 10);
    std::uniform_int_distribution<int> exponent(-120, 120);
    for (int k = 0; k < 20000; ++k) {
        const int power = exponent(random);
        const double x = (k % 2 ? -1 : 1) * mantissa(random) * std::pow(10.0, power);
        const std::string text = coordinate(x);
        ASSERT_LE(text.size(), 20u) << x;
        // Fifteen digits; fourteen with an exponent of three, or one that becomes so when the point is left out.
        ASSERT_NEAR(std::stod(text) / x, 1, power > -85 && power < 99 ? 5e-15 : 5e-14) << text;
    }
    EXPECT_EQ(std::stod(coordinate(1.0 / 3)), 1.0 / 3);
    EXPECT_EQ(std::stod(coordinate(-1.0 / 3)), -1.0 / 3);
}

TEST(AppendCoordinate, DoesNotRoundTheLargestToInfinity) {
    const double largest = std::numeric_limits<double>::max();
    for (const double x : {largest, -largest, std::nextafter(largest, 0), 1.797693134862315e308}) {
        const std::string text = coordinate(x);
        EXPECT_LE(text.size(), 20u);
        EXPECT_NEAR(std::stod(text) / x, 1, 1e-13) << text;
        EXPECT_NEAR(std::stod(coordinate(-x)) / -x, 1, 1e-13);
    }
}

TEST(AppendInteger, WritesDigits) {
    std::string out = "1, ";
    append_integer(out, 0);
    append_integer(out, -45);
    append_integer(out, std::numeric_limits<Index>::max());
    EXPECT_EQ(out, "1, 0-459223372036854775807");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
