// SPDX-License-Identifier: LGPL-2.1-or-later
// The border of a square of side 2, and of a disk.
#include "tools/face_border.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Circ.hxx>
#include <gp_Pln.hxx>

#include <cmath>
#include <set>

#include "error.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using Eigen::Vector3d;

TopoDS_Shape square() { return BRepBuilderAPI_MakeFace(gp_Pln(), -1, 1, -1, 1).Face(); }

TopoDS_Shape disk(double radius) {
    const gp_Circ circle(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), radius);
    return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire()).Face();
}

FacePlace in_plane(double x, double y) { return {{x, y, 0}, {0, 0, 1}}; }

TEST(ChainSet, HasAllOneOrThoseMarked) {
    EXPECT_TRUE(ChainSet::all().has_all());
    EXPECT_TRUE(ChainSet::all().has(7));
    EXPECT_FALSE(ChainSet::only(2).has_all());
    EXPECT_TRUE(ChainSet::only(2).has(2));
    EXPECT_FALSE(ChainSet::only(2).has(0));
    const ChainSet marked = ChainSet::marked({1, 0, 1});
    EXPECT_FALSE(marked.has_all());
    EXPECT_TRUE(marked.has(2));
    EXPECT_FALSE(marked.has(1));
}

TEST(FaceBorder, OfASquareHasFourChainsThatMeetInCorners) {
    const FaceBorder border(square(), 2);
    EXPECT_FALSE(border.empty());
    ASSERT_EQ(border.chains().size(), 4u);
    ASSERT_EQ(border.joints().size(), 4u);
    for (const FaceBorder::Joint& j : border.joints()) {
        EXPECT_NEAR(std::abs(j.at.x()), 1, 1e-12);
        EXPECT_NEAR(std::abs(j.at.y()), 1, 1e-12);
        EXPECT_NE(j.before, j.after);
        EXPECT_EQ(border.chains()[j.before].ends.back().neighbour, j.after);
        EXPECT_LT((border.chains()[j.after].ends.front().at - j.at).norm(), 1e-12);
    }
    for (const FaceBorder::Chain& c : border.chains()) {
        EXPECT_EQ(c.ends.size(), 2u);
        EXPECT_TRUE(std::isinf(c.least_radius));
    }
}

TEST(FaceBorder, TellsInsideFromOutside) {
    const FaceBorder border(square(), 2);
    const auto beyond = [&](double x, double y) {
        return border.foot(in_plane(x, y), ChainSet::all()).beyond({x, y, 0});
    };
    EXPECT_NEAR(beyond(0.25, 0), -0.75, 1e-12);
    EXPECT_NEAR(beyond(1.5, 0), 0.5, 1e-12);
    EXPECT_NEAR(beyond(4, 5), 5, 1e-12) << "from a corner, where both sides are as near";
    EXPECT_LT((border.foot(in_plane(1.5, 0.5), ChainSet::all()).at - Vector3d(1, 0.5, 0)).norm(), 1e-12);
}

TEST(FaceBorder, GoesOnStraightBesideChainsThatDoNotCount) {
    const FaceBorder border(square(), 2);
    const int right = border.foot(in_plane(1.5, 0), ChainSet::all()).chain;
    const FaceBorder::Foot foot = border.foot(in_plane(1.5, 7), ChainSet::only(right));
    EXPECT_EQ(foot.chain, right);
    EXPECT_LT((foot.at - Vector3d(1, 7, 0)).norm(), 1e-12);
    EXPECT_NEAR(foot.beyond({1.5, 7, 0}), 0.5, 1e-12);
    // With its neighbour it ends in the corner.
    std::vector<char> marks(4, 1);
    EXPECT_LT((border.foot(in_plane(1.5, 7), ChainSet::marked(marks)).at - Vector3d(1, 1, 0)).norm(), 1e-12);
}

TEST(FaceBorder, OfADiskIsOneClosedChain) {
    const FaceBorder border(disk(3), 6);
    ASSERT_EQ(border.chains().size(), 1u);
    EXPECT_TRUE(border.chains()[0].ends.empty());
    EXPECT_NEAR(border.chains()[0].least_radius, 3, 1e-9);
    EXPECT_TRUE(border.joints().empty());
    EXPECT_NEAR(border.foot(in_plane(1, 0), ChainSet::all()).beyond({1, 0, 0}), -2, 1e-9);
    EXPECT_NEAR(border.foot(in_plane(3, 4), ChainSet::all()).beyond({3, 4, 0}), 2, 1e-9);
}

TEST(FaceBorder, RefusesFacesThatMeetAtAnAngle) {
    EXPECT_THAT([] { FaceBorder(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), 3); },
                testing::ThrowsMessage<ToolError>(testing::HasSubstr("its faces meet at 90 degrees")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
