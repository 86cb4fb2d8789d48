// SPDX-License-Identifier: LGPL-2.1-or-later
// The front of a crack that ends in a cube of eight, along its middle plane.
#include "cutting/border.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cutting/snap.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::HasSubstr;

const Plane plane({1, 0, 0}, {1, 0, 0});

/// A cube of eight with the faces in x = 1 collected.
Workpiece cut_cube(const Mesh& mesh) {
    Workpiece f = checks::whole_workpiece(mesh, plane);
    cut_along(f, {.tool = &plane, .bound = {}, .inside = {}, .tag = 0});
    return f;
}

int alive(const auto& list) {
    int count = 0;
    for (int s = 0; s < list.size(); ++s) count += list.alive(s);
    return count;
}

TEST(CutBorder, TakesNodesThatLieOnIt) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = cut_cube(mesh);
    const Patch patch = HalfPlane({1, 1, 0}, {0, -1, 0}).on(plane);
    const Tool* side = patch.sides[0].get();
    cut_border(f, patch);
    EXPECT_EQ(f.d.band.size(), 27);
    for (int v = 0; v < f.d.band.size(); ++v) {
        const Vec3& at = f.d.band.nodes[v].at;
        EXPECT_EQ(at, f.d.band.nodes[v].start);
        EXPECT_EQ(f.d.contact[v].has(side), at.x() == 1 && at.y() == 1);
    }
}

TEST(CutBorder, MovesNearNodesWithinTheInterface) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = cut_cube(mesh);
    const Patch patch = HalfPlane({1, 1.2, 0}, {0, -1, 0}).on(plane);
    cut_border(f, patch);
    EXPECT_EQ(f.d.band.size(), 27);
    for (const double z : {0, 1, 2}) {
        const int v = node_at(f.d.band, {1, 1.2, z});
        EXPECT_EQ(f.d.contact[v].count(), 2);
        EXPECT_EQ(f.d.band.nodes[v].start, Vec3(1, 1, z));
    }
}

TEST(CutBorder, BisectsEdgesThatStillCross) {
    // Pressed so that the border is too far from nodes to be moved onto.
    Mesh mesh = checks::grid(2, 2, 2);
    for (Vec3& x : mesh.points) x.z() *= 0.1;
    Workpiece f = cut_cube(mesh);
    const Patch patch = HalfPlane({1, 0.5, 0}, {0, 1, 0}).on(plane);
    cut_border(f, patch);
    // Of the edges and diagonals in x = 1 those from y = 0 to y = 1: three and two.
    EXPECT_EQ(f.d.band.size(), 27 + 5);
    const BandMesh& band = f.d.band;
    for (int v = 0; v < band.size(); ++v) {
        EXPECT_EQ(f.d.contact[v].count() == 2, band.is_new(v));
        if (f.d.contact[v].count() == 2) {
            EXPECT_NEAR(patch.distance(band.nodes[v].at), 0, 1e-9);
        }
    }
    for (int s = 0; s < band.cut_faces.size(); ++s) {
        double low = 0, high = 0;
        for (const int v : band.cut_faces[s]) {
            low = std::min(low, patch.distance(band.nodes[v].at));
            high = std::max(high, patch.distance(band.nodes[v].at));
        }
        EXPECT_TRUE(low > -1e-9 || high < 1e-9) << "no face reaches over the border";
    }
}

TEST(CutBorder, MakesCornersNodes) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = cut_cube(mesh);
    const Vec3 corner(1, 1.1, 0.9);
    const Patch patch = Polygon({corner, {1, 5, 0.9}, {1, 5, 5}, {1, 1.1, 5}}).on(plane);
    cut_border(f, patch);
    const int v = node_at(f.d.band, corner);
    EXPECT_EQ(f.d.band.nodes[v].start, Vec3(1, 1, 1));
    EXPECT_EQ(f.d.contact[v].count(), 3);
}

TEST(KeepPatch, LeavesTheFacesInside) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = cut_cube(mesh);
    const Patch patch = HalfPlane({1, 1, 0}, {0, -1, 0}).on(plane);
    cut_border(f, patch);
    ASSERT_EQ(alive(f.d.band.cut_faces), 8);
    keep_patch(f, patch);
    ASSERT_EQ(alive(f.d.band.cut_faces), 4);
    for (int s = 0; s < f.d.band.cut_faces.size(); ++s)
        for (const int v : f.d.band.cut_faces[s]) {
            EXPECT_TRUE(!f.d.band.cut_faces.alive(s) || f.d.band.nodes[v].at.y() <= 1);
        }
    for (int v = 0; v < f.d.band.size(); ++v) {
        const Vec3& at = f.d.band.nodes[v].at;
        EXPECT_EQ(static_cast<bool>(f.d.contact[v]), at.x() == 1 && at.y() <= 1);
    }
    EXPECT_TRUE(f.released.empty()) << "nodes that did not move are where they belong";
}

TEST(KeepPatch, SendsNodesHomeThatTheToolWasNotWantedAt) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Plane beside({1.2, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, beside);
    cut_along(f, {.tool = &beside, .bound = {}, .inside = {}, .tag = 0});
    const Patch patch = HalfPlane({1.2, 1, 0}, {0, -1, 0}).on(beside);
    cut_border(f, patch);
    ASSERT_NO_THROW(node_at(f.d.band, {1.2, 2, 1}));
    keep_patch(f, patch);
    EXPECT_NO_THROW(node_at(f.d.band, {1, 2, 1}));
    EXPECT_NO_THROW(node_at(f.d.band, {1.2, 0, 1}));
}

TEST(KeepPatch, RefusesPatchesThatNoFaceFitsIn) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = cut_cube(mesh);
    const Patch small = Disk({1, 0.6, 0.3}, 0.15).on(plane);
    EXPECT_THAT([&] { keep_patch(f, small); },
                testing::ThrowsMessage<ToolError>(HasSubstr("no element face fits in it")));
    const Patch tiny = Disk({1, 0.613, 0.317}, 1e-3).on(plane);
    EXPECT_THAT([&] { keep_patch(f, tiny); },
                testing::ThrowsMessage<ToolError>(HasSubstr("no element face fits in it")));
    const Patch touching = Disk({1, -0.5, 1}, 0.5).on(plane);
    EXPECT_THAT([&] { keep_patch(f, touching); },
                testing::ThrowsMessage<ToolError>(HasSubstr("there is no material within its front")));
    const Patch outside = HalfPlane({1, 5, 0}, {0, 1, 0}).on(plane);
    EXPECT_THAT([&] { keep_patch(f, outside); },
                testing::ThrowsMessage<ToolError>(HasSubstr("the crack lies outside the part")));
}

TEST(PartClosedFaces, GivesAFaceOnTheFrontANodeInside) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = cut_cube(mesh);
    const Patch patch = HalfPlane({1, 9, 0}, {0, -1, 0}).on(plane);
    EXPECT_FALSE(part_closed_faces(f, patch)) << "no node is on the front";
    const std::array<int, 3> face = f.d.band.cut_faces[0];
    for (const int v : face) f.d.contact[v] = f.d.contact[v].with(patch.sides[0].get());
    EXPECT_TRUE(part_closed_faces(f, patch));
    // First its longest edge gets a node, then the others, which would join the lips from front to front.
    ASSERT_EQ(f.d.band.size(), 30);
    const auto middle = [&](int a, int b) -> Vec3 { return (f.d.band.nodes[a].at + f.d.band.nodes[b].at) / 2; };
    std::vector<Vec3> middles{middle(face[0], face[1]), middle(face[1], face[2]), middle(face[2], face[0])};
    for (int v = 27; v < 30; ++v) {
        EXPECT_THAT(middles, testing::Contains(f.d.band.nodes[v].at));
        EXPECT_EQ(f.d.contact[v].count(), 1);
        EXPECT_TRUE(f.d.contact[v].has(&plane));
    }
    const Vec3 first = f.d.band.nodes[27].at;
    EXPECT_EQ(first.y() - std::floor(first.y()), 0.5) << "a diagonal of a square";
    EXPECT_EQ(first.z() - std::floor(first.z()), 0.5);
    EXPECT_FALSE(part_closed_faces(f, patch)) << "once is enough";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
