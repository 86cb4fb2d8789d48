// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/unweld.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

/// With the nodes below in a group.
Mesh input() {
    Mesh mesh = checks::touching_tetrahedra();
    const GroupIndex both = mesh.add_group("BELOW", GroupKind::node);
    set_group_members(mesh, both, {GroupKind::node, {11, 12, 13}, {}});
    return mesh;
}

std::vector<Index> numbers(const Mesh& mesh, Index cell) {
    std::vector<Index> out;
    for (const Index n : mesh.block(CellType::tetra).nodes(cell)) out.push_back(mesh.node_ids[n]);
    return out;
}

/// The pieces of the welded face, by elements above.
void set_welded(Mesh& mesh, const Welded& welded, std::vector<Index> elements) {
    std::vector<Index> faces(elements.size(), 1);
    set_group_members(mesh, welded.faces, {GroupKind::facet, std::move(elements), std::move(faces)});
}

TEST(Unweld, NothingChangedIsTheInput) {
    const Mesh before = input();
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    Mesh mesh = welded->mesh;
    Changes changes;
    const Unwelded out = unweld(before, *welded, mesh, changes, {100, 50});
    EXPECT_EQ(out.moved + out.born + out.doubled, 0);
    EXPECT_EQ(mesh.points, before.points);
    EXPECT_EQ(mesh.node_ids, before.node_ids);
    EXPECT_EQ(mesh.block(CellType::tetra).connectivity, before.block(CellType::tetra).connectivity);
    EXPECT_THAT(group_members(mesh, 0).ids, ElementsAre(11, 12, 13));
    EXPECT_TRUE(changes.empty());
}

TEST(Unweld, ASpringBetweenTheTwoStaysSoWhicheverComesFirst) {
    Mesh before = input();
    before.add_cell(CellType::line, std::array<Index, 2>{0, 4}, 3);
    before.add_cell(CellType::line, std::array<Index, 2>{5, 1}, 4);
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    Mesh mesh = welded->mesh;
    EXPECT_EQ(mesh.block(CellType::line).size(), 0);
    mesh.points[1] = {1.5, 0, 0};
    Changes changes;
    unweld(before, *welded, mesh, changes, {100, 50});
    EXPECT_EQ(mesh.block(CellType::line).connectivity, before.block(CellType::line).connectivity);
    EXPECT_EQ(mesh.points[5], Vec3(1.5, 0, 0));
    EXPECT_THAT(numbers(mesh, 1), ElementsAre(11, 13, 12, 14));
}

TEST(Unweld, WhatMovesAndIsBornDoesSoOnBothSides) {
    const Mesh before = input();
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    Mesh mesh = welded->mesh;
    // Node 1 moves, the edge 1-2 is split at the node 100: elements 1 and 3 above, 2 and 4 below.
    mesh.points[0] = {0.5, 0, 0};
    const Index born = mesh.add_node({1, 0, 0}, 100, mesh.node_families[0]);
    mesh.block(CellType::tetra).connectivity = {0, born, 2, 3, 0, 2, born, 7};
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{born, 1, 2, 3}, 3);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{born, 2, 1, 7}, 4);
    set_welded(mesh, *welded, {1, 3});
    Changes changes;
    changes.born.push_back({100, {1, 2}, {{1, 0.5}, {2, 0.5}}});
    changes.parts = {{3, 1}, {4, 2}};
    const Unwelded out = unweld(before, *welded, mesh, changes, {101, 50});
    EXPECT_EQ(out.moved, 1);
    EXPECT_EQ(out.born, 1);
    EXPECT_EQ(out.doubled, 0);
    EXPECT_THAT(numbers(mesh, 0), ElementsAre(1, 100, 3, 4));
    EXPECT_THAT(numbers(mesh, 1), ElementsAre(11, 13, 101, 14));
    EXPECT_THAT(numbers(mesh, 2), ElementsAre(100, 2, 3, 4));
    EXPECT_THAT(numbers(mesh, 3), ElementsAre(101, 13, 12, 14));
    EXPECT_EQ(mesh.points[4], Vec3(0.5, 0, 0));
    EXPECT_THAT(group_members(mesh, 0).ids, UnorderedElementsAre(11, 12, 13, 101));
    ASSERT_EQ(changes.born.size(), 2u);
    EXPECT_EQ(changes.born[1].node, 101);
    EXPECT_THAT(changes.born[1].ancestors, ElementsAre(11, 12));
    EXPECT_THAT(changes.born[1].shares,
                ElementsAre(std::pair<Index, double>(11, 0.5), std::pair<Index, double>(12, 0.5)));
    EXPECT_THAT(out.partners.at(100), ElementsAre(101));
}

TEST(Unweld, ASideThatIsGoneTakesItsNodesAlong) {
    const Mesh before = input();
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    Mesh mesh = welded->mesh;
    CellBlock& block = mesh.block(CellType::tetra);
    block.connectivity.resize(4);
    block.ids.resize(1);
    block.families.resize(1);
    Changes changes;
    unweld(before, *welded, mesh, changes, {100, 50});
    EXPECT_THAT(numbers(mesh, 0), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 4, 14));  // of the node 14 the operation had to think
}

/// A crack's copies 101, 102, 103 of the single nodes; the first one's index.
Index add_copies(Mesh& mesh, Changes& changes) {
    const Index first = mesh.node_count();
    for (const Index n : {0, 1, 2}) {
        mesh.add_node(Vec3(mesh.points[n]), 101 + n);
        changes.copies.push_back({101 + n, mesh.node_ids[n]});
    }
    return first;
}

TEST(Unweld, ACrackThroughBothDoublesBoth) {
    const Mesh before = input();
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    // As if tetrahedra 3 and 4 were on the other lip of a crack, at copies of the nodes 1, 2, 3.
    Mesh mesh = welded->mesh;
    Changes changes;
    const Index p = add_copies(mesh, changes);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{p, p + 1, p + 2, 3}, 3);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{p, p + 2, p + 1, 7}, 4);
    set_welded(mesh, *welded, {1, 3});
    changes.parts = {{3, 1}, {4, 2}};
    const Unwelded out = unweld(before, *welded, mesh, changes, {104, 50});
    EXPECT_EQ(out.doubled, 3);
    EXPECT_THAT(numbers(mesh, 0), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(numbers(mesh, 1), ElementsAre(11, 13, 12, 14));
    EXPECT_THAT(numbers(mesh, 2), ElementsAre(101, 102, 103, 4));
    EXPECT_THAT(numbers(mesh, 3), ElementsAre(104, 106, 105, 14));
    EXPECT_EQ(changes.copies.size(), 6u);
    EXPECT_EQ(changes.copies[3].source, 11);
}

TEST(Unweld, ACrackAlongTheWeldOpensNothing) {
    const Mesh before = input();
    const auto welded = weld(before, 0);
    ASSERT_TRUE(welded);
    Mesh mesh = welded->mesh;
    Changes changes;
    const Index p = add_copies(mesh, changes);
    mesh.block(CellType::tetra).connectivity = {p, p + 1, p + 2, 3, 0, 2, 1, 7};
    unweld(before, *welded, mesh, changes, {104, 50});
    EXPECT_THAT(numbers(mesh, 0), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(numbers(mesh, 1), ElementsAre(11, 13, 12, 14));
    EXPECT_TRUE(changes.copies.empty());
    EXPECT_EQ(mesh.node_ids, before.node_ids);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
