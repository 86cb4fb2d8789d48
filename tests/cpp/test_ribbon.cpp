// SPDX-License-Identifier: LGPL-2.1-or-later
// Strips that stand on a surface along a line.
#include "tools/ribbon.h"

#include <gtest/gtest.h>

#include "error.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using Eigen::Vector3d;

/// Along x, then along y, in the plane z = 0.
Ribbon corner() { return {{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}}, {3, Vector3d::UnitZ()}, false}; }

Ribbon square() { return {{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {4, Vector3d::UnitZ()}, true}; }

TEST(Ribbon, MeasuresAlongTheSurface) {
    const Ribbon line = corner();
    const double side = line.distance({1, 0.5, 0});
    EXPECT_NEAR(std::abs(side), 0.5, 1e-12);
    EXPECT_NEAR(line.distance({1, -0.5, 0}), -side, 1e-12);
    EXPECT_NEAR(line.distance({1, 0.5, 7}), side, 1e-12);  // however high above
    EXPECT_NEAR(std::abs(line.distance({2.4, 2, 0})), 0.4, 1e-12);
}

TEST(Ribbon, ItsNormalIsTheGradientOfTheDistance) {
    const Ribbon line = corner();
    for (const Vector3d& x :
         {Vector3d(0.7, 0.3, 0.1), Vector3d(0.7, -0.3, 0), Vector3d(2.3, 1, 0), Vector3d(2.2, -0.3, 0)}) {
        const Vector3d n = line.normal(x);
        EXPECT_NEAR(n.norm(), 1, 1e-12);
        for (int k = 0; k < 3; ++k) {
            const Vector3d step = 1e-6 * Vector3d::Unit(k);
            EXPECT_NEAR((line.distance(x + step) - line.distance(x - step)) / 2e-6, n[k], 1e-5);
        }
        EXPECT_NEAR(line.distance(line.project(x)), 0, 1e-12);
    }
}

TEST(Ribbon, GoesOnStraightBeyondItsEnds) {
    const Ribbon line = corner();
    EXPECT_NEAR(std::abs(line.distance({-5, 0.5, 0})), 0.5, 1e-12);
    EXPECT_NEAR(line.beyond({-5, 0.5, 0}), 5, 1e-12);
    EXPECT_NEAR(line.beyond({2.5, 4, 0}), 1, 1e-12);
    EXPECT_NEAR(line.beyond({1, 0.5, 0.2}), 0.2, 1e-12);  // off the surface
}

TEST(Ribbon, KnowsLengths) {
    EXPECT_DOUBLE_EQ(corner().length(), 5);
    EXPECT_NEAR((corner().at(3) - Vector3d(2, 1, 0)).norm(), 0, 1e-12);
    const Ribbon closed = square();
    EXPECT_DOUBLE_EQ(closed.length(), 8);
    EXPECT_NEAR((closed.at(9) - Vector3d(1, 0, 0)).norm(), 0, 1e-12);
    EXPECT_NEAR(closed.arc_between(7.5, 0.5), 1, 1e-12);
    EXPECT_NEAR(corner().arc_between(4.5, 0.5), -4, 1e-12);
    EXPECT_NEAR(closed.foot({1.5, -1, 0}).arc, 1.5, 1e-12);
}

TEST(Ribbon, HasARadiusWhereItBends) {
    EXPECT_TRUE(std::isinf(Ribbon({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, {3, Vector3d::UnitZ()}, false).feature_size()));
    std::vector<Vector3d> circle;
    for (int k = 0; k < 24; ++k) circle.emplace_back(3 * std::cos(k * M_PI / 12), 3 * std::sin(k * M_PI / 12), 0);
    EXPECT_NEAR(Ribbon(circle, {24, Vector3d::UnitZ()}, true).feature_size(), 3, 0.05);
}

TEST(Ribbon, RefusesWhatIsNoLine) {
    EXPECT_THROW(Ribbon({{0, 0, 0}}, {Vector3d::UnitZ()}, false), ToolError);
    EXPECT_THROW(Ribbon({{0, 0, 0}, {0, 0, 0}}, {2, Vector3d::UnitZ()}, false), ToolError);
    EXPECT_THROW(Ribbon({{0, 0, 0}, {1, 0, 0}}, {Vector3d::UnitZ()}, false), ToolError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
