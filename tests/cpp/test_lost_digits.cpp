// SPDX-License-Identifier: LGPL-2.1-or-later
// Coordinates that files have no room for.
#include "io/lost_digits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(LostDigits, AreThoseOfTheNodesThatChange) {
    Mesh mesh;
    mesh.add_node({1, 2, 3}, 7);
    mesh.add_node({0.25, 2, 3.5}, 8);
    mesh.add_node({1, 0.125, 3}, 9);
    LostDigits lost(mesh, [](double x) { return std::floor(x); });
    EXPECT_THAT(lost.nodes, testing::ElementsAre(1, 2));
    EXPECT_THAT(lost.off, testing::ElementsAre(0.5, 0.125));
    EXPECT_EQ(lost.told(), "the last digits of the coordinates of 2 nodes (they are off by up to 0.5)");
    EXPECT_FALSE(LostDigits(mesh, [](double x) { return x; }).told());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
