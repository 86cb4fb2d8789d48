// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/root.h"

#include <gtest/gtest.h>

#include <cmath>

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(RootBetween, IsExactInOneStepWhereTheValueIsLinear) {
    int calls = 0;
    const double t = root_between(-1, 3, 1e-12, [&](double x) {
        ++calls;
        return -1 + 4 * x;
    });
    EXPECT_EQ(t, 0.25);
    EXPECT_EQ(calls, 1);
}

TEST(RootBetween, IsCalledLastAtTheRoot) {
    double last = -1;
    const double t = root_between(2, -5, 1e-13, [&](double x) {
        last = x;
        return 2 - 7 * x * x * x * x * x;
    });
    EXPECT_EQ(t, last);
    EXPECT_NEAR(t, std::pow(2.0 / 7, 0.2), 1e-12);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
