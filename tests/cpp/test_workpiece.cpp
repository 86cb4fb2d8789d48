// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/workpiece.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "tools/sphere.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::ElementsAre;
using testing::IsEmpty;

const Plane plane({1.5, 0, 0}, {1, 0, 0});

TEST(Workpiece, KnowsOfANodeBornOnAnEdge) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    const int a = node_at(f.d.band, {1, 1, 1}), b = node_at(f.d.band, {2, 1, 1});
    const int on = f.split_edge(a, b, Vec3(1.5, 1, 1), &plane);
    ASSERT_EQ(on, 27);
    EXPECT_EQ(f.distance.size(), 28u);
    EXPECT_EQ(f.distance[on], 0);
    EXPECT_TRUE(f.d.contact[on].has(&plane));
    EXPECT_EQ(f.d.constraints[on].freedom, NodeFreedom::free);
    EXPECT_EQ(f.d.band.births[0].a, a);
    EXPECT_EQ(f.d.band.births[0].b, b);
    // On the skin's edge, off the tool.
    const int beside = f.split_edge(node_at(f.d.band, {1, 0, 0}), node_at(f.d.band, {2, 0, 0}), Vec3(1.25, 0, 0), {});
    EXPECT_EQ(f.distance[beside], -0.25);
    EXPECT_FALSE(f.d.contact[beside]);
    EXPECT_EQ(f.d.constraints[beside].freedom, NodeFreedom::curve);
    EXPECT_TRUE(f.d.constraints.is_exterior(beside));
    // Within the tolerance of the tool it is as good as on it.
    const int close =
        f.split_edge(node_at(f.d.band, {1, 2, 2}), node_at(f.d.band, {2, 2, 2}), Vec3(1.5 + 5e-10, 2, 2), {});
    EXPECT_EQ(f.distance[close], 0);
}

TEST(Workpiece, ValueIsNothingInContact) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Sphere sphere({0, 0, 0}, 1);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    const int v = node_at(f.d.band, {2, 0, 0});
    EXPECT_EQ(f.value(v, plane), 0.5);
    EXPECT_EQ(f.value(v, sphere), 1);
    f.d.band.nodes[v].at.x() = 1.75;
    EXPECT_EQ(f.value(v, plane), 0.5) << "the side its elements are on, as it was";
    EXPECT_EQ(f.value(v, sphere), 0.75);
    f.d.contact[v] = Contact(&plane).with(&sphere);
    EXPECT_EQ(f.value(v, plane), 0);
    EXPECT_EQ(f.value(v, sphere), 0);
}

TEST(Workpiece, HoldsANodeByThePartItMay) {
    const Mesh mesh = checks::grid(1, 1, 1);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    EXPECT_EQ(f.part_to_hold(3), close_beside);
    f.may_hold = {0, 0, 0, 0.01};
    EXPECT_EQ(f.part_to_hold(3), 0.01);
    EXPECT_EQ(f.part_to_hold(2), close_beside);
    EXPECT_EQ(f.part_to_hold(7), close_beside) << "not for all nodes";
}

/// x of some nodes, each once.
std::vector<double> xs(const Workpiece& f, const std::vector<int>& nodes) {
    std::vector<double> out;
    for (const int v : nodes) out.push_back(f.d.band.nodes[v].at.x());
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

TEST(FindNodeSets, GoesAsFarAsTheBandwidth) {
    const Mesh mesh = checks::grid(6, 1, 1);
    const Plane middle({3, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, middle);
    find_node_sets(f);
    EXPECT_EQ(f.nodes.size(), 4u);
    EXPECT_THAT(xs(f, f.nodes), ElementsAre(3));
    EXPECT_EQ(f.transition.size(), 16u);
    EXPECT_THAT(xs(f, f.transition), ElementsAre(1, 2, 4, 5));
    EXPECT_TRUE(std::ranges::is_sorted(f.transition));
    f.bandwidth = 1;
    f.d.band.nodes[node_at(f.d.band, {2, 0, 0})].level = -1;
    find_node_sets(f);
    EXPECT_EQ(f.transition.size(), 7u) << "what must not move does not count";
}

TEST(MovableNodes, AreThoseOfTheSetsAndReleasedOnes) {
    const Mesh mesh = checks::grid(6, 1, 1);
    const Plane middle({3, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, middle);
    f.bandwidth = 1;
    find_node_sets(f);
    const int corner = node_at(f.d.band, {0, 0, 0}), on = node_at(f.d.band, {3, 0, 0});
    f.released = {corner, on};
    const std::vector<int> movable = movable_nodes(f);
    EXPECT_EQ(movable.size(), 13u);
    EXPECT_THAT(xs(f, movable), ElementsAre(0, 2, 3, 4));
    EXPECT_TRUE(std::ranges::is_sorted(movable));
}

TEST(RelaxNear, MovesOnlyWhatIsNear) {
    const Mesh mesh = checks::grid(12, 2, 2);
    const Plane through({0, 1, 0}, {0, 1, 0});
    Workpiece f = checks::whole_workpiece(mesh, through);
    BandMesh& band = f.d.band;
    const int near = node_at(band, {2, 1, 1}), far = node_at(band, {10, 1, 1});
    band.nodes[near].at.x() = 2.9;
    band.nodes[far].at.x() = 10.9;
    relax_near(f, {near});
    EXPECT_LT(band.nodes[near].at.x(), 2.8);
    EXPECT_EQ(band.nodes[far].at.x(), 10.9);
    EXPECT_NEAR(band.nodes[near].at.y(), 1, 1e-9) << "along its tool";
}

TEST(SplitAtFixedMiddles, SplitsTheEdgesThatTheBladeCrosses) {
    Mesh mesh = checks::second_order(checks::grid(2, 1, 1));
    const Index middle = checks::number_near(mesh, {1.5, 0, 0});
    mesh.node_families[middle] = checks::family_of(mesh, "ALONE", GroupKind::node);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    const Plane other({0.5, 0, 0}, {1, 0, 0});
    split_at_fixed_middles(f, {.tool = &other, .bound = {}, .inside = {}}, mesh);
    EXPECT_EQ(f.d.band.size(), 12) << "it crosses no such edge";
    split_at_fixed_middles(f, {.tool = &plane, .bound = [](const Vec3&) { return 9.0; }, .inside = {}}, mesh);
    EXPECT_EQ(f.d.band.size(), 12) << "it is not wanted there";
    split_at_fixed_middles(f, {.tool = &plane, .bound = {}, .inside = {}}, mesh);
    ASSERT_EQ(f.d.band.size(), 13);
    EXPECT_EQ(f.d.band.nodes[12].at, Vec3(1.5, 0, 0));
    EXPECT_EQ(f.d.band.nodes[12].global, middle);
    EXPECT_EQ(f.d.constraints[12].freedom, NodeFreedom::fixed);
    EXPECT_TRUE(f.d.contact[12].has(&plane));
}

TEST(SplitAtFixedMiddles, HasNothingToDoWithoutSuchNodes) {
    const Mesh mesh = checks::second_order(checks::grid(2, 1, 1));
    Workpiece f = checks::whole_workpiece(mesh, plane);
    split_at_fixed_middles(f, {.tool = &plane, .bound = {}, .inside = {}}, mesh);
    EXPECT_EQ(f.d.band.size(), 12);
    EXPECT_THAT(f.d.band.births, IsEmpty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
