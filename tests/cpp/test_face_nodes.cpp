// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/face_nodes.h"

#include <gtest/gtest.h>

#include "operators/feature_line.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// A tetrahedron with a triangle, FACE, on it, and two node groups: of its nodes, and of the skin's node 4.
Mesh with_groups() {
    Mesh mesh;
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
        mesh.add_node(x, mesh.node_count() + 1, 0);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 1, 0);
    const GroupIndex face = mesh.add_group("FACE", GroupKind::element),
                     nodes = mesh.add_group("NODES", GroupKind::node), tip = mesh.add_group("TIP", GroupKind::node);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 2, 1}, 2, mesh.families.with(0, face));
    for (const Index n : {0, 1, 2}) mesh.node_families[n] = mesh.families.with(0, nodes);
    mesh.node_families[3] = mesh.families.with(0, tip);
    return mesh;
}

TEST(FaceNodes, FollowTheTriangles) {
    const Mesh before = with_groups();
    Result result;
    result.mesh = before;
    GroupRecord record;
    record.name = "NODES";
    record.count_before = record.count_after = 3;
    result.report.groups.push_back(record);
    // The face got a node more, of another family.
    const Index born = result.mesh.add_node({0.5, 0.5, 0}, 5, 0);
    const FamilyIndex face = result.mesh.families.with(0, *result.mesh.find_group("FACE", GroupKind::element));
    result.mesh.add_cell(CellType::triangle, std::array<Index, 3>{1, 2, born}, 3, face);
    keep_face_nodes(before, skin_of(before), result);
    const GroupIndex nodes = *result.mesh.find_group("NODES", GroupKind::node);
    EXPECT_EQ(group_members(result.mesh, nodes).ids, (std::vector<Index>{1, 2, 3, 5}));
    EXPECT_EQ(result.report.groups[0].count_after, 4);
}

TEST(FaceNodes, LeaveGroupsOfTheSkinWhenInside) {
    const Mesh before = with_groups();
    Result result;
    result.mesh = before;
    const Index born = result.mesh.add_node({0.1, 0.1, 0.1}, 5, 0);
    const GroupIndex tip = *result.mesh.find_group("TIP", GroupKind::node);
    result.mesh.node_families[born] = result.mesh.families.with(0, tip);
    keep_face_nodes(before, skin_of(before), result);
    EXPECT_EQ(group_members(result.mesh, tip).ids, (std::vector<Index>{4}));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
