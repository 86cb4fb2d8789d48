// SPDX-License-Identifier: LGPL-2.1-or-later
// Folded second-order elements get straight edges: around the middle node of a cube of eight, one side of which may
// bulge.
#include "cutting/straighten.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cutting/mend_curved.h"
#include "simple_meshes.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// How far the side x = 2 is out there.
double bulge_of_side(double height, const Vec3& x) {
    return height * (1 - (std::pow(x.y() - 1, 2) + std::pow(x.z() - 1, 2)) / 2);
}

Mesh with_bulging_side(double height) {
    Mesh mesh = checks::second_order(checks::grid(2, 2, 2));
    for (Vec3& x : mesh.points)
        if (x.x() == 2) x.x() += bulge_of_side(height, x);
    return mesh;
}

struct Straighten : testing::Test {
    explicit Straighten(double height = 0)
        : mesh(with_bulging_side(height)),
          f(checks::whole_workpiece(mesh, checks::away)),
          middle(node_at(f.d.band, {1, 1, 1})),
          top(node_at(f.d.band, {2 + height, 1, 1})),
          beside(node_at(f.d.band, {2 + height / 2, 2, 1})) {}

    /// Of the edge a-b, along it: more than elements can have.
    void fold(int a, int b) {
        f.d.mids.set_bulge(a, b, 0.3 * (f.d.band.nodes[b].at - f.d.band.nodes[a].at));
        f.d.band.nodes[a].at.z() += 1e-6;
    }

    Mesh mesh;
    Workpiece f;
    int middle, top, beside;
};

struct StraightenBesideBulge : Straighten {
    StraightenBesideBulge() : Straighten(0.1) {}
};

TEST_F(Straighten, LeavesSoundElementsAlone) {
    f.d.mids.set_bulge(middle, top, Vec3(0.1, 0, 0));
    EXPECT_TRUE(straighten_folded(f));
    EXPECT_EQ(f.d.mids.bulge(middle, top), Vec3(0.1, 0, 0));
}

TEST_F(Straighten, MakesAnEdgeInsideStraightWithoutAWord) {
    fold(middle, top);
    ASSERT_EQ(folded_elements(f, least_curved).size(), 6u);
    EXPECT_TRUE(straighten_folded(f));
    EXPECT_THAT(folded_elements(f, 0.9), IsEmpty());
    EXPECT_TRUE(f.d.mids.is_straightened(middle, top));
    EXPECT_FALSE(f.d.mids.is_straightened(middle, beside));
    EXPECT_THAT(f.warnings, IsEmpty()) << "it is beside nothing";
}

TEST_F(StraightenBesideBulge, SaysHowFarAndWhereAnEdgeIsBesideItsSurface) {
    fold(top, beside);
    ASSERT_FALSE(folded_elements(f, least_curved).empty());
    EXPECT_TRUE(straighten_folded(f));
    EXPECT_THAT(folded_elements(f, least_curved), IsEmpty());
    EXPECT_THAT(f.warnings,
                ElementsAre(AllOf(HasSubstr("1 node was left in the middle of straight edges"),
                                  HasSubstr("up to 0.0125 beside where they belong, farthest near (2.08  1.5    1)"))));
    const Vec3 chord = (f.d.band.nodes[top].at + f.d.band.nodes[beside].at) / 2;
    EXPECT_EQ(mid_side(f.d, top, beside).at, chord);
    EXPECT_TRUE(mid_side(f.d, top, beside).fits);
}

TEST_F(StraightenBesideBulge, CountsNewNodesBesideTheirSurfaceUpToALimit) {
    Workpiece far = f;
    f.split_edge(top, beside, Vec3(2.0, 1.5, 1), {});
    EXPECT_TRUE(straighten_folded(f));
    EXPECT_THAT(f.warnings, ElementsAre(HasSubstr("farthest near (  2 1.5   1)")));
    far.split_edge(top, beside, Vec3(2.9, 1.5, 1), {});
    EXPECT_FALSE(straighten_folded(far));
    EXPECT_THAT(far.warnings, IsEmpty());
}

TEST_F(Straighten, DoesNotTakeNodesOffTheirTool) {
    f.split_edge(middle, top, Vec3(1.5, 1, 1), &checks::away);
    EXPECT_FALSE(straighten_folded(f));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
