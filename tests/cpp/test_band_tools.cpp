// SPDX-License-Identifier: LGPL-2.1-or-later
// The band's building blocks that were written for speed, against the plain way.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/quality.h"
#include "mesh/rows.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(Quality, InverseCubeRootIsExactToRounding) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-200, 200);
    for (int k = 0; k < 100000; ++k) {
        const double x = std::exp(exponent(random));
        ASSERT_NEAR(inverse_cube_root(x) * std::cbrt(x), 1, 2e-15) << x;
    }
}

TEST(Quality, BelowALimitIsWhatTheMeanRatioSays) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    int below = 0, inverted = 0;
    for (int k = 0; k < 20000; ++k) {
        std::array<Vec3, 4> p;
        for (Vec3& x : p) x = Vec3(normal(random), normal(random), normal(random)) * std::pow(10.0, k % 7 - 3);
        if (k % 5 == 0) p[3] = (p[0] + p[1] + p[2]) / 3;  // flat
        const double q = mean_ratio(p[0], p[1], p[2], p[3]);
        for (const double limit : {1e-6, 0.1, 0.35, 0.55})
            ASSERT_EQ(mean_ratio_below(limit, p[0], p[1], p[2], p[3]), q < limit) << q;
        if (q > 0) {
            EXPECT_FALSE(mean_ratio_below(q, p[0], p[1], p[2], p[3]));
            EXPECT_TRUE(mean_ratio_below(std::nextafter(q, 2.0), p[0], p[1], p[2], p[3]));
        }
        below += q < 0.35;
        inverted += q < 0;
    }
    EXPECT_GT(below, 1000);
    EXPECT_GT(inverted, 1000);
    const Vec3 nowhere = Vec3::Constant(std::nan(""));
    EXPECT_TRUE(mean_ratio_below(0.1, nowhere, Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()));
}

TEST(Rows, AreListsOfLists) {
    std::mt19937 random(3);
    const int count = 50;
    std::vector<std::vector<int>> plain(count);
    std::vector<int> room(count);
    for (int& r : room) r = static_cast<int>(random() % 4);
    Rows rows;
    rows.reserve(room);
    for (int step = 0; step < 20000; ++step) {
        const int r = static_cast<int>(random() % count), value = static_cast<int>(random() % 9);
        switch (random() % 8) {
            case 0:
                std::erase(plain[r], value), rows.remove(r, value);
                break;
            case 1:
                std::ranges::replace(plain[r], value, value + 1), rows.replace(r, value, value + 1);
                break;
            case 2:
                if (step % 50 == 0) plain[r].clear(), rows.clear(r);
                break;
            default:
                plain[r].push_back(value), rows.add(r, value);
        }
        if (step == 10000) plain.resize(count + 5), rows.resize(count + 5);
    }
    for (std::size_t r = 0; r < plain.size(); ++r)
        EXPECT_TRUE(std::ranges::equal(rows[static_cast<int>(r)], plain[r])) << r;
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
