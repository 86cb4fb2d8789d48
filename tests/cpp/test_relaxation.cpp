// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/relaxation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::away;
using checks::node_at;

struct Relaxation : testing::Test, checks::CubeOfEight {
    Vec3& at = d.band.nodes[middle].at;
};

TEST_F(Relaxation, BringsANodeToTheMiddleOfItsElements) {
    at = {1.6, 0.7, 1.2};
    EXPECT_GT(relax(d, {middle}, {.target = 1, .sweeps = 30}), 0);
    EXPECT_LT((at - Vec3(1, 1, 1)).norm(), 1e-3);
    EXPECT_GT(d.visits, 0);
}

TEST_F(Relaxation, StopsWhereElementsAreGoodEnough) {
    at = {1.8, 1, 1};
    relax(d, {middle});
    EXPECT_GE(quality_around(d, middle, at), 0.55);
    const Vec3 before = at;
    EXPECT_EQ(relax(d, {middle}), 0);
    EXPECT_EQ(at, before);
}

TEST_F(Relaxation, LeavesOthersAlone) {
    at = {1.8, 1, 1};
    // A corner of the skin stays where it is although it may move; the middle may not.
    EXPECT_EQ(relax(d, {node_at(d.band, {2, 2, 2})}), 0);
    for (const BandNode& n : d.band.nodes)
        if (&n.at != &at) {
            EXPECT_EQ(n.at, n.start);
        }
    EXPECT_EQ(at, Vec3(1.8, 1, 1));
}

TEST_F(Relaxation, KeepsNodesOnTheirTools) {
    const Plane slanting({1.5, 1, 1}, {1, 1, 0});
    at = {1.6, 0.9, 1};
    d.contact[middle] = &slanting;
    EXPECT_GT(relax(d, {middle}, {.target = 1, .sweeps = 30}), 0);
    EXPECT_LT(std::abs(slanting.distance(at)), 1e-12);
    EXPECT_LT((at - Vec3(1.25, 1.25, 1)).norm(), 0.2) << "the point of the plane nearest to the middle";
}

TEST_F(Relaxation, DoesNotPassABarrier) {
    const Plane wall({1.4, 0, 0}, {1, 0, 0});
    at = {1.6, 1, 1};
    d.barrier = &wall;
    d.side[middle] = 1;
    relax(d, {middle}, {.target = 1, .sweeps = 30});
    EXPECT_GT(at.x(), 1.4);
    EXPECT_LT(at.x(), 1.6);
}

TEST(RelaxFrom, BeginsNearAChange) {
    const Mesh mesh = checks::grid(8, 2, 2);
    Deformable d = checks::whole_workpiece(mesh, away).d;
    const int near = node_at(d.band, {2, 1, 1}), far = node_at(d.band, {6, 1, 1});
    d.band.nodes[near].at.x() = 2.8;
    d.band.nodes[far].at.x() = 6.8;
    EXPECT_GT(relax_from(d, {near}, {near, far}), 0);
    EXPECT_LT(d.band.nodes[near].at.x(), 2.8);
    EXPECT_EQ(d.band.nodes[far].at.x(), 6.8) << "what is not near moves only as far as others around it do";
}

TEST(RelaxationOfShells, MovesNodesOfShells) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
    Deformable d = checks::whole_workpiece(mesh, away).d;
    const int middle = node_at(d.band, {1, 1, 0});
    d.band.nodes[middle].at = {1.7, 0.8, 0};
    relax(d, {middle}, {.target = 1, .sweeps = 30});
    EXPECT_LT((d.band.nodes[middle].at - Vec3(1, 1, 0)).norm(), 1e-3);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
