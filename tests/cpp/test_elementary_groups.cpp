// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/elementary_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ElementaryGroups, AreTheClassesOfOverlappingGroups) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 1);  // nodes 1 to 6, triangles 1 to 4
    mesh.add_cell(CellType::line, std::array<Index, 2>{0, 1}, 9);
    const GroupIndex a = mesh.add_group("A", GroupKind::node), b = mesh.add_group("B", GroupKind::node),
                     all = mesh.add_group("ALL", GroupKind::element), sides = mesh.add_group("SIDES", GroupKind::facet),
                     hidden = mesh.add_group("*CARD", GroupKind::element, true);
    const auto family = [&](std::vector<GroupIndex> groups) { return mesh.families.intern(groups); };
    mesh.node_families = {family({a}), family({a, b}), family({b}), 0, family({a, b}), 0};
    mesh.block(CellType::triangle).families = {family({all}), family({all, hidden}), family({hidden}), 0};
    mesh.block(CellType::line).families = {family({all})};
    mesh.facets = {{CellType::triangle, 3, family({sides}), 2}, {CellType::triangle, 2, family({sides}), 0}};
    const std::vector<ElementaryGroup> classes = elementary_groups(mesh);
    ASSERT_EQ(classes.size(), 7u);
    const auto expect = [&](std::size_t k, GroupKind kind, int dimension, const std::vector<GroupIndex>& groups,
                            const std::vector<Index>& ids) {
        EXPECT_EQ(classes[k].kind, kind) << k;
        EXPECT_EQ(classes[k].dimension, dimension) << k;
        EXPECT_EQ(classes[k].groups, groups) << k;
        EXPECT_EQ(classes[k].members.ids, ids) << k;
    };
    expect(0, GroupKind::node, 0, {a}, {mesh.node_ids[0]});
    expect(1, GroupKind::node, 0, {a, b}, {mesh.node_ids[1], mesh.node_ids[4]});
    expect(2, GroupKind::node, 0, {b}, {mesh.node_ids[2]});
    expect(3, GroupKind::element, 1, {all}, {9});
    expect(4, GroupKind::element, 2, {all}, {1, 2});
    expect(5, GroupKind::facet, 1, {sides}, {3});
    EXPECT_THAT(classes[5].members.faces, ElementsAre(3));
    expect(6, GroupKind::facet, 2, {sides}, {1});
    EXPECT_THAT(classes[6].members.faces, ElementsAre(2));
}

TEST(ElementaryGroups, AreNoneWithoutGroups) { EXPECT_THAT(elementary_groups(checks::grid(1, 1, 1)), IsEmpty()); }

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
