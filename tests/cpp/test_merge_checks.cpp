// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge_checks.h"

#include <gtest/gtest.h>

#include "cutting/crossing.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

Mesh pair_of_triangles(const Vec3& by) {
    Mesh mesh;
    const std::array<Vec3, 6> points{Vec3{0, 0, 0},      Vec3{2, 0, 0},     Vec3{0, 2, 0},
                                     Vec3{0.5, 0.5, -1}, Vec3{0.5, 0.5, 2}, Vec3{3, 3, 0}};
    for (Index k = 0; k < 6; ++k) mesh.add_node(k < 3 ? points[k] : Vec3(points[k] + by), k + 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{3, 4, 5}, 2);
    return mesh;
}

TEST(MergeChecks, AShellThatCrossesItself) {
    EXPECT_THROW(check_itself(pair_of_triangles(Vec3::Zero())), ToolError);
    EXPECT_NO_THROW(check_itself(pair_of_triangles({3, 0, 0})));
    // An edge that stands on the other is no crossing.
    Mesh standing = pair_of_triangles(Vec3::Zero());
    standing.points[3] = {0.5, 0.5, 0};
    standing.points[4] = {0.5, 0.5, 2};
    standing.points[5] = {1, 0.5, 0};
    EXPECT_NO_THROW(check_itself(standing));
}

/// A triangle in z = 0, and one that stands across it whose edges meet nothing of it but its edges: from (1 0 0) to a
/// point of the one from (2 0 0) to (0 2 0).
Mesh crossing_at_edges() {
    Mesh mesh;
    const std::array<Vec3, 6> points{Vec3{0, 0, 0},   Vec3{2, 0, 0},     Vec3{0, 2, 0},
                                     Vec3{1, 0.5, 1}, Vec3{1, -0.5, -1}, Vec3{1, 1.5, -1}};
    for (Index k = 0; k < 6; ++k) mesh.add_node(points[k], k + 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{3, 4, 5}, 2);
    return mesh;
}

TEST(MergeChecks, ShellsThatCrossFromEdgeToEdge) {
    const Mesh mesh = crossing_at_edges();
    const std::array<std::array<Index, 3>, 2> parts{{{0, 1, 2}, {3, 4, 5}}};
    ASSERT_FALSE(crossed_element(mesh, parts)) << "or this test is not of what sees what that does not";
    try {
        check_itself(mesh);
        FAIL() << "not seen";
    } catch (const ToolError& error) {
        EXPECT_STREQ(error.parameter(), "other");
        EXPECT_NE(std::string(error.what()).find("(  1 0.5   0)"), std::string::npos) << error.what();
    }
    // One that but touches the other's edges, and one that has a node in common with it.
    Mesh beside = mesh;
    for (const Index n : {3, 4, 5}) beside.points[n][0] = 2;
    EXPECT_NO_THROW(check_itself(beside));
    Mesh joined = mesh;
    joined.points[0] = {1, -0.5, -1};
    joined.block(CellType::triangle).connectivity[0] = 4;
    EXPECT_NO_THROW(check_itself(joined));
}

TEST(MergeChecks, OneInsideTheOther) {
    Mesh small = checks::grid(1, 1, 1);
    for (Vec3& x : small.points) x = 0.5 * x + Vec3::Constant(1.2);
    const Mesh large = checks::grid(3, 3, 3);
    EXPECT_THROW(check_within(large, small), ToolError);
    EXPECT_THROW(check_within(small, large), ToolError);
    for (Vec3& x : small.points) x[0] += 10;
    EXPECT_NO_THROW(check_within(large, small));
}

TEST(MergeChecks, GroupsThatBecameEmpty) {
    Mesh before = checks::grid(1, 1, 1);
    const FamilyIndex all = checks::family_of(before, "A", GroupKind::node);
    before.add_group("NONE", GroupKind::node);
    Mesh after = before;
    before.node_families[0] = all;
    EXPECT_EQ(emptied_groups(before, after), std::vector<std::string>{"A"});
    EXPECT_TRUE(emptied_groups(before, before).empty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
