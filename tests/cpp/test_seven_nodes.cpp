// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/seven_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;

/// The triangle 1 of the nodes 1 to 7, its second edge in the facet group EDGE.
Mesh one_triangle() {
    Mesh mesh;
    for (const Vec3& x :
         {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0.7, 0.6, 0)})
        mesh.add_node(x, mesh.node_count() + 1);
    mesh.add_cell(CellType::triangle7, std::array<Index, 7>{0, 1, 2, 3, 4, 5, 6}, 1);
    const GroupIndex edge = mesh.add_group("EDGE", GroupKind::facet);
    set_group_members(mesh, edge, {GroupKind::facet, {1}, {4}});
    return mesh;
}

TEST(SevenNodes, WhatDidNotChangeIsTheInput) {
    const Mesh input = one_triangle();
    SevenNodes seven(input);
    ASSERT_TRUE(seven);
    EXPECT_EQ(seven.mesh().block(CellType::triangle7).size(), 0);
    EXPECT_THAT(seven.mesh().block(CellType::triangle6).nodes(0), ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_EQ(seven.mesh().largest_node_id(), 7) << "no new node may get its number";
    Result result{seven.mesh(), {}};
    seven.finish(result);
    EXPECT_EQ(result.mesh.points, input.points);
    EXPECT_EQ(result.mesh.node_ids, input.node_ids);
    EXPECT_THAT(result.mesh.block(CellType::triangle7).nodes(0), ElementsAre(0, 1, 2, 3, 4, 5, 6));
    EXPECT_THAT(group_members(result.mesh, 0).faces, ElementsAre(4));
}

TEST(SevenNodes, AMiddleFollowsItsTriangle) {
    const Mesh input = one_triangle();
    SevenNodes seven(input);
    Result result{seven.mesh(), {}};
    result.mesh.points[1] = {2.9, 0, 0};
    seven.finish(result);
    const Vec3& middle = result.mesh.points[6];
    EXPECT_NEAR(middle[0], 4.0 / 9 * 2 - 2.9 / 9, 1e-15);
    EXPECT_NEAR(middle[1], 4.0 / 9 * 2 - 2.0 / 9, 1e-15);
    EXPECT_EQ(result.mesh.node_ids[6], 7);
}

TEST(SevenNodes, NothingWithout) {
    Mesh mesh;
    EXPECT_FALSE(SevenNodes(mesh));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
