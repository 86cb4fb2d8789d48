// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/pieces.h"

#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// Two boxes of 1 and 3 cubes that do not touch, the large one of higher numbers of nodes.
Mesh two_boxes() {
    Mesh mesh = checks::grid(1, 1, 1);
    const Mesh other = checks::grid(3, 1, 1);
    const Index first = mesh.node_count();
    for (Index n = 0; n < other.node_count(); ++n)
        mesh.add_node(other.points[n] + Vec3(5, 0, 0), mesh.largest_node_id() + 1);
    const CellBlock& cells = other.block(CellType::tetra);
    for (Index c = 0; c < cells.size(); ++c) {
        std::vector<Index> nodes(cells.nodes(c).begin(), cells.nodes(c).end());
        for (Index& n : nodes) n += first;
        mesh.add_cell(CellType::tetra, nodes, mesh.largest_cell_id() + 1);
    }
    return mesh;
}

TEST(Pieces, OfOneBodyAndOfNothing) {
    const Pieces one = find_pieces(checks::grid(2, 2, 1));
    ASSERT_EQ(one.list.size(), 1U);
    EXPECT_EQ(one.list[0].elements, 24);
    EXPECT_EQ(one.list[0].dimension, 3);
    EXPECT_NEAR(one.list[0].measure, 4, 1e-12);
    EXPECT_NEAR((one.list[0].place - Vec3(1, 1, 0.5)).norm(), 0, 1e-12);
    EXPECT_EQ(one.of_node, std::vector<int>(18, 0));
    EXPECT_TRUE(find_pieces(Mesh()).list.empty());
}

TEST(Pieces, LargestFirst) {
    const Mesh mesh = two_boxes();
    const Pieces found = find_pieces(mesh);
    ASSERT_EQ(found.list.size(), 2U);
    EXPECT_NEAR(found.list[0].measure, 3, 1e-12);
    EXPECT_NEAR(found.list[1].measure, 1, 1e-12);
    EXPECT_NEAR((found.list[0].place - Vec3(6.5, 0.5, 0.5)).norm(), 0, 1e-12);
    EXPECT_EQ(found.list[1].elements, 6);
    for (Index n = 0; n < mesh.node_count(); ++n) EXPECT_EQ(found.of_node[n], mesh.points[n].x() > 3 ? 0 : 1);
}

TEST(Pieces, SegmentsJoinPointsAndLooseNodesDoNot) {
    Mesh mesh = two_boxes();
    const Index loose = mesh.add_node({9, 9, 9}, 900, checks::family_of(mesh, "ALONE", GroupKind::node));
    mesh.add_cell(CellType::vertex, std::vector<Index>{loose}, 900,
                  checks::family_of(mesh, "POINT", GroupKind::element));
    mesh.add_cell(CellType::vertex, std::vector<Index>{0}, 901);
    Pieces found = find_pieces(mesh);
    ASSERT_EQ(found.list.size(), 2U);
    EXPECT_EQ(found.of_node[loose], -1);
    EXPECT_EQ(found.list[1].elements, 6) << "points do not count";
    EXPECT_TRUE(found.list[0].groups.empty());
    // A spring between the boxes, then one away from both.
    mesh.add_cell(CellType::line, std::vector<Index>{0, loose - 1}, 902);
    found = find_pieces(mesh);
    ASSERT_EQ(found.list.size(), 1U);
    EXPECT_NEAR(found.list[0].measure, 4, 1e-12) << "the spring has no volume";
    EXPECT_EQ(found.list[0].elements, 25);
    const Index end = mesh.add_node({9, 9, 11}, 901);
    mesh.add_cell(CellType::line, std::vector<Index>{loose, end}, 903);
    found = find_pieces(mesh);
    ASSERT_EQ(found.list.size(), 2U);
    EXPECT_EQ(found.list[1].dimension, 1);
    EXPECT_NEAR(found.list[1].measure, 2, 1e-12);
    EXPECT_EQ(found.list[1].groups.size(), 2U) << "of its node and its point";
}

TEST(Pieces, HaveTheGroupsOfNodesElementsAndFacets) {
    Mesh mesh = two_boxes();
    mesh.node_families[0] = checks::family_of(mesh, "HELD", GroupKind::node);
    mesh.block(CellType::tetra).families.back() = checks::family_of(mesh, "LAST", GroupKind::element);
    mesh.facets.push_back({CellType::tetra, 1, checks::family_of(mesh, "LOADED", GroupKind::facet), 0});
    const GroupIndex hidden = mesh.add_group("HIDDEN", GroupKind::element, true);
    mesh.block(CellType::tetra).families[1] = mesh.families.intern(std::vector<GroupIndex>{hidden});
    const Pieces found = find_pieces(mesh);
    const auto index = [&](const char* name) { return *mesh.find_group(name); };
    EXPECT_EQ(found.list[0].groups, std::vector<int>{index("LAST")});
    EXPECT_EQ(found.list[1].groups, (std::vector<int>{index("HELD"), index("LOADED")}));
}

TEST(Pieces, DoubleNodesPartAndElementsWithoutSizeHaveAPlace) {
    EXPECT_EQ(find_pieces(checks::touching_tetrahedra()).list.size(), 2U);
    Mesh mesh;
    for (Index n = 0; n < 3; ++n) mesh.add_node({4, 5, 6}, n + 1);
    mesh.add_cell(CellType::triangle, std::vector<Index>{0, 1, 2}, 1);
    const Pieces found = find_pieces(mesh);
    ASSERT_EQ(found.list.size(), 1U);
    EXPECT_EQ(found.list[0].measure, 0);
    EXPECT_EQ(found.list[0].place, Vec3(4, 5, 6));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
