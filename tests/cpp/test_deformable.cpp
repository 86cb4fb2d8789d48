// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/deformable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simple_meshes.h"
#include "tools/contact.h"
#include "tools/plane.h"
#include "tools/sphere.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::ElementsAre;

const Plane away({100, 0, 0}, {1, 0, 0}), in_x({1, 0, 0}, {1, 0, 0}), in_y({0, 1, 0}, {0, 1, 0});
/// Goes through the corners of a square in x = 1, and bulges over its middle.
const Sphere ball({0, 1, 1}, std::sqrt(3.0));

struct DeformableTest : testing::Test {
    Mesh mesh = checks::grid(2, 2, 2);
    Deformable d = checks::whole_workpiece(mesh, away).d;
    int middle = node_at(d.band, {1, 1, 1}), end = node_at(d.band, {2, 1, 1});
};

TEST_F(DeformableTest, KnowsOfANodeBornOnAnEdge) {
    d.barrier = &in_x;
    d.held_off[middle] = 0.25;
    const int on = d.split_edge(middle, end, Vec3(1.5, 1, 1), &in_y);
    ASSERT_EQ(on, 27);
    EXPECT_THAT(d.contact[on].tools(), ElementsAre(&in_y));
    EXPECT_EQ(d.side[on], 1);
    EXPECT_EQ(d.off_tool[on], 0);
    EXPECT_EQ(d.held_off[on], 0.25) << "as its ends are beside their tools, so is it";
    EXPECT_EQ(d.constraints[on].freedom, NodeFreedom::free);
    const int off = d.split_edge(middle, node_at(d.band, {0, 1, 1}), Vec3(0.5, 1, 1), {});
    EXPECT_EQ(d.side[off], -1);
    EXPECT_EQ(d.held_off[off], 0);
    const int barrier = d.split_edge(middle, node_at(d.band, {1, 2, 1}), Vec3(1, 1.5, 1), &in_x);
    EXPECT_EQ(d.side[barrier], 0);
}

TEST_F(DeformableTest, HoldsANodeBeside) {
    const Plane beside({1.125, 0, 0}, {1, 0, 0});
    d.contact[middle] = &beside;
    EXPECT_EQ(d.off_tools(middle), 0.125);
    d.hold_beside(middle, Contact(&beside).with(&in_y));
    EXPECT_EQ(d.held_off[middle], 0.125);
    EXPECT_EQ(d.off_tools(middle), 0);
    EXPECT_EQ(d.contact[middle].count(), 2);
    EXPECT_EQ(d.constraints[middle].freedom, NodeFreedom::fixed);
    d.band.nodes[middle].at.x() = 0.5;
    EXPECT_EQ(d.off_tools(middle), 0.5) << "beyond what it was held off";
    EXPECT_EQ(d.held_between(middle, end), 0.125);
}

TEST_F(DeformableTest, BarsNodesFromGoingBehindTheBarrier) {
    d.barrier = &in_x;
    d.side[end] = 1;
    EXPECT_FALSE(d.is_barred(end, {1.1, 1, 1}));
    EXPECT_TRUE(d.is_barred(end, {1, 1, 1}));
    EXPECT_TRUE(d.is_barred(end, {0.9, 1, 1}));
    d.side[end] = 0;
    EXPECT_FALSE(d.is_barred(end, {0.9, 1, 1}));
}

TEST_F(DeformableTest, FollowsEdges) {
    EXPECT_LT((d.along_edge(middle, end, 0.25) - Vec3(1.25, 1, 1)).norm(), 1e-15);
    const Mesh curved_mesh = checks::second_order(mesh);
    Deformable curved = checks::whole_workpiece(curved_mesh, away).d;
    curved.mids.set_bulge(middle, end, Vec3(0, 0.1, 0));
    EXPECT_LT((curved.along_edge(middle, end, 0.25) - Vec3(1.25, 1 + 4 * 0.1 * 3 / 16, 1)).norm(), 1e-15);
}

TEST_F(DeformableTest, FindsTheWorstPartOfASplit) {
    const double half = d.worst_part(middle, end, {1.5, 1, 1});
    EXPECT_GT(half, 0.3);
    EXPECT_LT(d.worst_part(middle, end, {1.05, 1, 1}), half / 2);
    EXPECT_LT(d.worst_part(middle, end, {2.5, 1, 1}), 0);
    // The parts in fact.
    d.split_edge(middle, end, Vec3(1.5, 1, 1), {});
    double worst = 1;
    for (const int t : d.band.tetras.around(27)) worst = std::min(worst, tetra_quality(d, t));
    EXPECT_NEAR(half, worst, 1e-15);
}

TEST_F(DeformableTest, FitsSplitsToSurfacesAndTools) {
    const auto free = d.fitted_split(middle, end, {1.4, 1.1, 1}, {});
    EXPECT_EQ(free.at, Vec3(1.4, 1.1, 1));
    EXPECT_TRUE(free.fits);
    EXPECT_NEAR(free.worst, d.worst_part(middle, end, {1.4, 1.1, 1}), 1e-15);
    const Plane at({1.5, 0, 0}, {1, 0, 0});
    const auto on_tool = d.fitted_split(middle, end, {1.4, 1, 1}, &at);
    EXPECT_LT((on_tool.at - Vec3(1.5, 1, 1)).norm(), 1e-12);
    EXPECT_TRUE(on_tool.fits);
    const auto on_skin = d.fitted_split(node_at(d.band, {1, 1, 2}), node_at(d.band, {2, 1, 2}), {1.5, 1, 1.9}, {});
    EXPECT_LT((on_skin.at - Vec3(1.5, 1, 2)).norm(), 1e-12);
    const auto nowhere = d.fitted_split(middle, end, {1.5, 1, 1}, &away);
    EXPECT_FALSE(nowhere.fits);
    EXPECT_EQ(nowhere.at, Vec3(1.5, 1, 1));
}

TEST_F(DeformableTest, KnowsWhichToolsAnEdgeLiesOn) {
    const int a = node_at(d.band, {1, 0, 0}), b = node_at(d.band, {1, 0, 2}), c = node_at(d.band, {1, 0, 1});
    EXPECT_FALSE(d.edge_contact(a, c));
    d.contact[a] = Contact(&in_x).with(&ball);
    d.contact[b] = Contact(&in_x).with(&ball);
    d.contact[c] = &in_x;
    EXPECT_THAT(d.edge_contact(a, c).tools(), ElementsAre(&in_x));
    // The chord from a to b is in the plane, but dips through the ball.
    EXPECT_THAT(d.edge_contact(a, b).tools(), ElementsAre(&in_x));
    d.band.cut_faces.add({a, b, node_at(d.band, {1, 2, 2})}, 0);
    EXPECT_EQ(d.edge_contact(a, b).count(), 2) << "the border of the faces that stand for both";
}

TEST_F(DeformableTest, MeasuresElements) {
    const double kuhn = 12 * std::cbrt(0.25) / 10;  // edges 1, 1, 1, sqrt 2, sqrt 2, sqrt 3, volume 1/6
    EXPECT_NEAR(tetra_quality(d, 0), kuhn, 1e-14);
    EXPECT_TRUE(tetra_is_below(kuhn + 1e-9, d, 0));
    EXPECT_FALSE(tetra_is_below(kuhn - 1e-9, d, 0));
    EXPECT_NEAR(quality_around(d, middle, {1, 1, 1}), kuhn, 1e-14);
    EXPECT_LE(quality_around(d, middle, {2.1, 1, 1}), 0);
    EXPECT_FALSE(quality_around_is_below(0.5, d, middle));
    d.band.nodes[middle].at.x() = 1.9;
    EXPECT_TRUE(quality_around_is_below(0.5, d, middle));
    EXPECT_TRUE(quality_around_is_below(0.5, d, end)) << "of the same elements";
    EXPECT_FALSE(quality_around_is_below(0.5, d, node_at(d.band, {0, 0, 2})));
}

TEST(DeformableShells, TurnOver) {
    Mesh mesh;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) mesh.add_node(at, mesh.node_count() + 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 1);
    Deformable d = checks::whole_workpiece(mesh, away).d;
    EXPECT_EQ(d.shell_normals[0], Vec3(0, 0, 1));
    const double right = std::sqrt(3.0) / 2;  // edges 1, 1, sqrt 2
    EXPECT_NEAR(shell_quality(d, 0), right, 1e-15);
    d.band.nodes[2].at.y() = -1;
    EXPECT_NEAR(shell_quality(d, 0), -right, 1e-15);
}

TEST(Contact, IsASetOfTools) {
    const Contact none, x(&in_x), both = x.with(&in_y);
    EXPECT_FALSE(none);
    EXPECT_FALSE(Contact(nullptr));
    EXPECT_EQ(both.count(), 2);
    EXPECT_EQ(both.with(&in_x).count(), 2) << "each once";
    EXPECT_TRUE(both.has(&in_y));
    EXPECT_FALSE(x.has(&in_y));
    EXPECT_THAT(both.without(&in_x).tools(), ElementsAre(&in_y));
    EXPECT_THAT(both.common(Contact(&away).with(&in_y)).tools(), ElementsAre(&in_y));
    EXPECT_TRUE(both.includes(x));
    EXPECT_FALSE(x.includes(both));
    EXPECT_FALSE(both.full());
    EXPECT_TRUE(both.with(&away).full());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
