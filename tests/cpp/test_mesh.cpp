// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;

Mesh two_triangles() {
    Mesh mesh;
    mesh.add_node({0, 0, 0}, 10);
    mesh.add_node({1, 0, 0}, 20);
    mesh.add_node({0, 1, 0}, 30);
    mesh.add_node({1, 1, 0}, 40);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 7);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{1, 3, 2}, 9);
    return mesh;
}

TEST(Mesh, GroupsMayOverlap) {
    Mesh mesh = two_triangles();
    const GroupIndex a = mesh.add_group("A", GroupKind::element);
    const GroupIndex b = mesh.add_group("B", GroupKind::element);
    const GroupIndex n = mesh.add_group("A", GroupKind::node);
    const GroupIndex f = mesh.add_group("F", GroupKind::facet);
    set_group_members(mesh, a, {GroupKind::element, {7, 9}, {}});
    set_group_members(mesh, b, {GroupKind::element, {9}, {}});
    set_group_members(mesh, n, {GroupKind::node, {40, 10}, {}});
    set_group_members(mesh, f, {GroupKind::facet, {9, 9}, {1, 3}});
    EXPECT_THAT(group_members(mesh, a).ids, ElementsAre(7, 9));
    EXPECT_THAT(group_members(mesh, b).ids, ElementsAre(9));
    EXPECT_THAT(group_members(mesh, n).ids, ElementsAre(10, 40));
    EXPECT_THAT(group_members(mesh, f).faces, ElementsAre(1, 3));
    remove_group(mesh, a);
    EXPECT_THAT(group_members(mesh, *mesh.find_group("B")).ids, ElementsAre(9));
    EXPECT_THAT(group_members(mesh, *mesh.find_group("F")).ids, ElementsAre(9, 9));
    mesh.validate();
}

TEST(Mesh, AssignGroupsEqualsOneByOne) {
    Mesh one = two_triangles(), all = two_triangles();
    const std::vector<GroupMembers> members = {{GroupKind::element, {9, 7}, {}},
                                               {GroupKind::node, {10, 20, 30}, {}},
                                               {GroupKind::facet, {7, 9}, {2, 5}},
                                               {GroupKind::element, {}, {}}};
    for (std::size_t g = 0; g < members.size(); ++g) {
        one.add_group("G" + std::to_string(g), members[g].kind);
        all.add_group("G" + std::to_string(g), members[g].kind);
        set_group_members(one, static_cast<GroupIndex>(g), members[g]);
    }
    assign_groups(all, members);
    for (std::size_t g = 0; g < members.size(); ++g) {
        EXPECT_EQ(group_members(one, static_cast<GroupIndex>(g)).ids,
                  group_members(all, static_cast<GroupIndex>(g)).ids);
        EXPECT_EQ(group_members(one, static_cast<GroupIndex>(g)).faces,
                  group_members(all, static_cast<GroupIndex>(g)).faces);
    }
}

TEST(Mesh, MissingMemberIsNamedAndChangesNothing) {
    Mesh mesh = two_triangles();
    const GroupIndex a = mesh.add_group("A", GroupKind::element);
    set_group_members(mesh, a, {GroupKind::element, {7}, {}});
    try {
        set_group_members(mesh, a, {GroupKind::element, {9, 8}, {}});
        FAIL();
    } catch (const Error& e) {
        EXPECT_THAT(e.what(), HasSubstr("'A' names element 8"));
    }
    EXPECT_THAT(group_members(mesh, a).ids, ElementsAre(7));
}

TEST(Mesh, ValidateNamesTheOffender) {
    Mesh mesh = two_triangles();
    mesh.node_ids[3] = 10;
    EXPECT_THROW(mesh.validate(), Error);
    mesh = two_triangles();
    mesh.points[1].x() = std::nan("");
    EXPECT_THROW(mesh.validate(), Error);
    mesh = two_triangles();
    mesh.block(CellType::triangle).connectivity[4] = 99;
    EXPECT_THROW(mesh.validate(), Error);
}

TEST(Mesh, NumbersLeaveRoomToCountOn) {
    Mesh mesh = two_triangles();
    mesh.node_ids[3] = largest_number;
    mesh.block(CellType::triangle).ids[1] = largest_number;
    EXPECT_NO_THROW(mesh.validate());
    EXPECT_NO_THROW(mesh.check_numbers());
    for (auto check : {&Mesh::validate, &Mesh::check_numbers}) {
        Mesh large = mesh;
        large.node_ids[3] = std::numeric_limits<Index>::max();
        EXPECT_THAT([&] { (large.*check)(); },
                    testing::ThrowsMessage<Error>(HasSubstr("the node number 9223372036854775807 is larger than")));
        large = mesh;
        large.block(CellType::triangle).ids[1] = largest_number + 1;
        EXPECT_THAT([&] { (large.*check)(); }, testing::ThrowsMessage<Error>(HasSubstr("the element number")));
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
