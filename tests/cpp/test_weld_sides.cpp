// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/weld_sides.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;

/// With the triangle 3 on that below.
Mesh input() {
    Mesh mesh = checks::touching_tetrahedra();
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{4, 5, 6}, 3);
    return mesh;
}

TEST(WeldSides, AWeldedFaceIsBetweenTwo) {
    const Mesh before = input();
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    const WeldSides sides(before, *welded, welded->mesh, {});
    EXPECT_THAT(sides.nodes(), ElementsAre(0, 1, 2));
    for (Index n = 0; n < 3; ++n) {
        const auto& at = sides.sides()[static_cast<std::size_t>(n)];
        ASSERT_EQ(at.size(), 2u);
        EXPECT_THAT(at[0].label, ElementsAre(n));
        EXPECT_THAT(at[0].cells, ElementsAre(CellRef{CellType::tetra, 0}));
        EXPECT_THAT(at[1].label, ElementsAre(n + 4));
        EXPECT_THAT(at[1].cells, ElementsAre(CellRef{CellType::tetra, 1}));
    }
    EXPECT_EQ(sides.joined(), 0);
}

TEST(WeldSides, AnElementOnTheFaceHasTwoHosts) {
    const Mesh before = input();
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    const WeldSides sides(before, *welded, welded->mesh, {});
    const auto guests = sides.guests();
    ASSERT_EQ(guests.size(), 1u);
    EXPECT_EQ(guests[0].cell, (CellRef{CellType::triangle, 0}));
    ASSERT_EQ(guests[0].hosts.size(), 2u);
    EXPECT_THAT(guests[0].hosts[1].second, ElementsAre(0, 2, 1));
    EXPECT_EQ(sides.votes(guests[0].cell, 1, {0}), -1);
    EXPECT_EQ(sides.votes(guests[0].cell, 1, {4}), 1);
}

TEST(WeldSides, WhatHangsTogetherByAFaceIsOne) {
    const Mesh before = input();
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    Mesh mesh = welded->mesh;
    set_group_members(mesh, welded->faces, {GroupKind::facet, {}, {}});
    const WeldSides sides(before, *welded, mesh, {});
    for (const auto& at : sides.sides()) EXPECT_EQ(at.size(), 1u);
    EXPECT_EQ(sides.joined(), 0);
}

TEST(WeldSides, AWeldedFaceWithoutDoubleNodesWouldBeJoined) {
    Mesh before = input();
    for (const Vec3& at : {Vec3(9, 0, 0), Vec3(10, 0, 0), Vec3(9, 1, 0), Vec3(9, 0, 1)}) before.add_node(at, 21);
    std::iota(before.node_ids.begin() + 8, before.node_ids.end(), 21);
    before.add_cell(CellType::tetra, std::array<Index, 4>{8, 9, 10, 11}, 4);
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    Mesh mesh = welded->mesh;
    set_group_members(mesh, welded->faces, {GroupKind::facet, {1, 4}, {1, 1}});
    EXPECT_EQ(WeldSides(before, *welded, mesh, {}).joined(), 1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
