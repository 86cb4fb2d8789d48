// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge_checks.h"

#include <gtest/gtest.h>

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
