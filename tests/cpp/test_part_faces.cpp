// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/part_faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/face_cover.h"
#include "operators/crack_faces.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

/// Hexahedra 1 and 2 on each other, the quadrangle 3 between them with its normal upwards; its nodes are 5 to 8.
Mesh two_hexahedra() {
    Mesh mesh;
    for (int k = 0; k < 3; ++k)
        for (const Vec3& x : {Vec3(0, 0, k), Vec3(1, 0, k), Vec3(1, 1, k), Vec3(0, 1, k)})
            mesh.add_node(x, mesh.node_count() + 1);
    mesh.add_cell(CellType::hexahedron, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7}, 1);
    mesh.add_cell(CellType::hexahedron, std::array<Index, 8>{4, 5, 6, 7, 8, 9, 10, 11}, 2);
    mesh.add_cell(CellType::quad, std::array<Index, 4>{4, 5, 6, 7}, 3);
    const GroupIndex wall = mesh.add_group("WALL", GroupKind::element);
    set_group_members(mesh, wall, {GroupKind::element, {3}, {}});
    return mesh;
}

const PartedNames names{"N", "P", "FRONT"};

std::vector<Index> members(const Mesh& mesh, const std::string& group) {
    return group_members(mesh, *mesh.find_group(group)).ids;
}

TEST(PartFaces, TheNegativeSideKeepsItsNodes) {
    const Mesh mesh = two_hexahedra();
    const Parted out = part_along(mesh, 0, names, {13, 4});
    EXPECT_THAT(out.doubled, ElementsAre(4, 5, 6, 7));
    EXPECT_THAT(out.mesh.block(CellType::hexahedron).nodes(0), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(out.mesh.block(CellType::hexahedron).nodes(1), ElementsAre(12, 13, 14, 15, 8, 9, 10, 11));
    EXPECT_THAT(members(out.mesh, "N"), ElementsAre(3));
    EXPECT_THAT(members(out.mesh, "P"), ElementsAre(4));
    EXPECT_THAT(members(out.mesh, "WALL"), UnorderedElementsAre(3, 4));
    EXPECT_THAT(out.mesh.block(CellType::quad).nodes(1), ElementsAre(12, 13, 14, 15));
    EXPECT_FALSE(out.mesh.find_group("FRONT"));
    ASSERT_EQ(out.changes.parts.size(), 1u);
    EXPECT_EQ(out.changes.parts[0].parent, 3);
}

TEST(PartFaces, NormalsTellTheSide) {
    Mesh mesh = two_hexahedra();
    mesh.block(CellType::quad).connectivity = {4, 7, 6, 5};
    const Parted out = part_along(mesh, 0, names, {13, 4});
    EXPECT_THAT(out.mesh.block(CellType::hexahedron).nodes(1), ElementsAre(4, 5, 6, 7, 8, 9, 10, 11));
}

TEST(PartFaces, FacetsTellTheSide) {
    Mesh mesh = two_hexahedra();
    const GroupIndex facets = mesh.add_group("FACETS", GroupKind::facet);
    set_group_members(mesh, facets, {GroupKind::facet, {2}, {1}});  // of the upper one
    const Parted out = part_along(mesh, facets, names, {13, 4});
    EXPECT_THAT(out.mesh.block(CellType::hexahedron).nodes(1), ElementsAre(4, 5, 6, 7, 8, 9, 10, 11));
}

TEST(PartFaces, WhatIsOutsideIsNot) {
    Mesh mesh = two_hexahedra();
    mesh.block(CellType::quad).connectivity = {0, 1, 2, 3};
    EXPECT_THROW(part_along(mesh, 0, names, {13, 4}), ToolError);
}

TEST(CrackAlongFaces, ReportsWhatCameApart) {
    const Mesh mesh = two_hexahedra();
    OperatorOptions options;
    options.name = "T";
    const Result result = crack_along_faces(mesh, "WALL", options);
    EXPECT_EQ(result.report.nodes_doubled, 4);
    EXPECT_EQ(result.report.elements_added, 1);
    ASSERT_EQ(result.report.groups.size(), 3u);
    EXPECT_EQ(result.report.groups[0].count_after, 2);
    EXPECT_DOUBLE_EQ(result.report.groups[0].measure_after, 2);
    EXPECT_EQ(result.report.groups[1].name, "T_N");
    EXPECT_EQ(result.report.groups[1].count_after, 1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
