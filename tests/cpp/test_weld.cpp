// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/weld.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;

/// Two tetrahedra on either side of z = 0 whose triangles there lie on each other, each with its own nodes.
Mesh two_tetrahedra(double apart = 0) {
    Mesh mesh;
    const double z[] = {0, -apart};
    for (int side = 0; side < 2; ++side) {
        const Vec3 at[] = {{0, 0, z[side]}, {1, 0, z[side]}, {0, 1, z[side]}, {0.2, 0.2, side ? -1.0 : 1.0}};
        for (const Vec3& x : at) mesh.add_node(x, 10 * (mesh.node_count() + 1));
    }
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 1);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{4, 6, 5, 7}, 2);
    return mesh;
}

TEST(Weld, FacesThatLieOnEachOther) {
    Mesh mesh = two_tetrahedra();
    const GroupIndex above = mesh.add_group("ABOVE", GroupKind::node), below = mesh.add_group("BELOW", GroupKind::node);
    set_group_members(mesh, above, {GroupKind::node, {10, 20}, {}});
    set_group_members(mesh, below, {GroupKind::node, {60, 70}, {}});
    const auto welded = weld(mesh, 0);
    ASSERT_TRUE(welded);
    EXPECT_THAT(welded->sets, ElementsAre(ElementsAre(0, 4), ElementsAre(1, 5), ElementsAre(2, 6)));
    EXPECT_EQ(welded->pairs(), 3);
    EXPECT_THAT(welded->mesh.block(CellType::tetra).nodes(1), ElementsAre(0, 2, 1, 7));
    EXPECT_EQ(welded->mesh.points, mesh.points);
    // In the groups of both.
    EXPECT_THAT(group_members(welded->mesh, below).ids, ElementsAre(20, 30, 60, 70));
    const GroupMembers faces = group_members(welded->mesh, welded->faces);
    EXPECT_THAT(faces.ids, ElementsAre(1));
    EXPECT_THAT(faces.faces, ElementsAre(1));
    EXPECT_TRUE(welded->mesh.groups[welded->faces].hidden);
}

TEST(Weld, NodesThatAreNotDoubleAreTheRim) {
    Mesh mesh = two_tetrahedra();
    mesh.block(CellType::tetra).connectivity[4] = 0;
    const auto welded = weld(mesh, 0);
    ASSERT_TRUE(welded);
    EXPECT_EQ(welded->pairs(), 2);
    EXPECT_THAT(group_members(welded->mesh, welded->rim).ids, ElementsAre(10));
    EXPECT_TRUE(welded->mesh.groups[welded->rim].hidden);
}

TEST(Weld, WithinRoundingOnly) {
    EXPECT_FALSE(weld(two_tetrahedra(1e-6), 0));
    EXPECT_TRUE(weld(two_tetrahedra(1e-6), 1e-6));
    EXPECT_FALSE(weld(two_tetrahedra(0.1), 1e-6));
}

TEST(Weld, NotWhereDivisionsDiffer) {
    Mesh mesh = two_tetrahedra();
    mesh.points[5] = {0.9, 0, 0};
    EXPECT_FALSE(weld(mesh, 0));
}

TEST(Weld, NodesBesideABorderOfTheGrid) {
    // Cells of the hash table end anywhere.
    for (const double shift : {0.0, 1e-13, 3e-13, 0.1, 1 / 3.0, 12345.678}) {
        Mesh mesh = two_tetrahedra();
        for (Vec3& x : mesh.points) x += Vec3(shift, shift, shift);
        mesh.points[4] += Vec3(1e-7, -1e-7, 1e-7);
        EXPECT_TRUE(weld(mesh, 2e-7)) << shift;
    }
}

TEST(Weld, ShellsOnEachOtherAndPlatesSideBySide) {
    Mesh mesh;
    for (int layer = 0; layer < 2; ++layer)
        for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) mesh.add_node(x, mesh.node_count() + 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{3, 4, 5}, 2);
    auto welded = weld(mesh, 0);
    ASSERT_TRUE(welded);
    EXPECT_EQ(welded->pairs(), 3);
    mesh.points[5] = {0, -1, 0};
    welded = weld(mesh, 0);
    ASSERT_TRUE(welded);
    EXPECT_THAT(welded->sets, ElementsAre(ElementsAre(0, 3), ElementsAre(1, 4)));
    EXPECT_THAT(group_members(welded->mesh, welded->faces).faces, ElementsAre(3));
}

TEST(Weld, ASpringOfNoLengthStaysBetweenItsNodes) {
    Mesh mesh = two_tetrahedra();
    mesh.add_cell(CellType::line, std::array<Index, 2>{0, 4}, 3);
    const auto welded = weld(mesh, 0);
    ASSERT_TRUE(welded);
    EXPECT_THAT(welded->mesh.block(CellType::line).nodes(0), ElementsAre(0, 4));
}

TEST(Weld, NothingInOneBody) {
    Mesh mesh = two_tetrahedra();
    mesh.block(CellType::tetra).connectivity = {0, 1, 2, 3, 0, 2, 1, 7};
    EXPECT_FALSE(weld(mesh, 0));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
