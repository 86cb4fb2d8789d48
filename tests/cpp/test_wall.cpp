// SPDX-License-Identifier: LGPL-2.1-or-later
// A part of the skin that is taken out of what is kept.
#include "cutting/wall.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wall_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::WithWall;

bool is_top(const Vec3& x) { return x.z() == 2; }

TEST(Wall, ItsNodesKeepToWhatIsBesideIt) {
    const WithWall w(checks::grid(2, 2, 2), is_top);
    const BandMesh& band = w.f.d.band;
    ASSERT_EQ(w.wall.patches.size(), 1U);
    EXPECT_EQ(w.wall.patches[0].parts.size(), 8U);
    EXPECT_EQ(w.wall.nodes.size(), 9U);
    const auto freedom = [&](const Vec3& x) { return w.f.d.constraints[checks::node_at(band, x)].freedom; };
    EXPECT_EQ(freedom({1, 1, 2}), NodeFreedom::free);
    EXPECT_EQ(freedom({1, 0, 2}), NodeFreedom::surface);
    EXPECT_EQ(freedom({0, 0, 2}), NodeFreedom::curve);
    EXPECT_EQ(freedom({1, 1, 0}), NodeFreedom::surface) << "elsewhere nothing changes";
    EXPECT_EQ(freedom({0, 0, 0}), NodeFreedom::fixed);
}

TEST(Wall, ItsFacesPointOutOfTheMaterial) {
    const WithWall w(checks::grid(2, 2, 2), is_top);
    const BandMesh& band = w.f.d.band;
    ASSERT_EQ(band.cut_faces.size(), 8);
    for (int s = 0; s < 8; ++s) {
        const auto& v = band.cut_faces[s];
        EXPECT_GT((band.nodes[v[1]].at - band.nodes[v[0]].at).cross(band.nodes[v[2]].at - band.nodes[v[0]].at).z(), 0);
    }
}

TEST(Wall, HeldNodesOfItAreFreeToGoWithIt) {
    Mesh mesh = checks::grid(2, 2, 2);
    const FamilyIndex family = checks::family_of(mesh, "GAUGE", GroupKind::node);
    mesh.node_families[checks::number_near(mesh, {1, 1, 2})] = family;
    const WithWall w(mesh, is_top);
    EXPECT_TRUE(w.f.d.constraints.is_held(checks::node_at(w.f.d.band, {1, 1, 2})));
    EXPECT_EQ(w.f.d.constraints[checks::node_at(w.f.d.band, {1, 1, 2})].freedom, NodeFreedom::free);
}

TEST(Wall, PatchesWhereSurfacesMeet) {
    const WithWall w(checks::grid(2, 2, 2), [](const Vec3& x) { return x.z() == 2 || x.x() == 2; });
    EXPECT_EQ(w.wall.patches.size(), 2U);
    EXPECT_EQ(wall_tags(w.f.d.band, checks::node_at(w.f.d.band, {2, 1, 2})).size(), 2U);
    EXPECT_EQ(wall_tags(w.f.d.band, checks::node_at(w.f.d.band, {2, 1, 1})).size(), 1U);
    EXPECT_TRUE(is_on_wall(w.f.d.band, checks::node_at(w.f.d.band, {2, 1, 1})));
    EXPECT_FALSE(is_on_wall(w.f.d.band, checks::node_at(w.f.d.band, {0, 1, 1})));
}

TEST(Wall, BordersOfShells) {
    Mesh mesh;
    checks::add_plate(mesh, Vec3::Zero(), {1, 0, 0}, {0, 1, 0}, 3, 3);
    const WithWall w(mesh, [](const Vec3& x) { return x.y() == 3; });
    EXPECT_EQ(w.f.d.band.cut_edges.size(), 3);
    EXPECT_EQ(w.f.d.constraints[checks::node_at(w.f.d.band, {1, 3, 0})].freedom, NodeFreedom::surface);
    EXPECT_EQ(w.f.d.constraints[checks::node_at(w.f.d.band, {3, 3, 0})].freedom, NodeFreedom::curve);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
