// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/held_inside.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;

const Plane plane({2, 0, 0}, {1, 0, 0});

Workpiece with_sets(const Mesh& mesh) {
    Workpiece f = checks::whole_workpiece(mesh, plane);
    find_node_sets(f);
    return f;
}

TEST(HeldInside, IsNothingWithoutGroups) {
    const HeldInside held = held_inside(with_sets(checks::grid(4, 4, 4)));
    EXPECT_EQ(held.inside, 27u) << "the skin does not count";
    EXPECT_EQ(held.on_borders, 0u);
    EXPECT_THAT(held.nodes, IsEmpty());
}

TEST(HeldInside, FindsNodesThatStayWhereTheyAre) {
    Mesh mesh = checks::grid(4, 4, 4);
    mesh.node_families[checks::number_near(mesh, {2, 2, 2})] = checks::family_of(mesh, "ALONE", GroupKind::node);
    const Workpiece f = with_sets(mesh);
    const HeldInside held = held_inside(f);
    EXPECT_EQ(held.on_borders, 1u);
    EXPECT_THAT(held.nodes, ElementsAre(checks::node_at(f.d.band, {2, 2, 2})));
}

TEST(HeldInside, CountsNodesThatStayOnABorder) {
    Mesh mesh = checks::grid(4, 4, 4);
    const FamilyIndex top = checks::family_of(mesh, "TOP", GroupKind::element);
    CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c) {
        double z = 0;
        for (const Index n : tetras.nodes(c)) z += mesh.points[n].z() / 4;
        if (z > 2) tetras.families[c] = top;
    }
    const HeldInside held = held_inside(with_sets(mesh));
    EXPECT_EQ(held.on_borders, 9u);
    EXPECT_THAT(held.nodes, IsEmpty()) << "on a plane they may move";
}

TEST(HeldInside, SaysWhenTheyAreMany) {
    const auto many = [](std::size_t nodes, std::size_t inside) {
        return HeldInside{std::vector<int>(nodes), nodes, inside}.many();
    };
    EXPECT_TRUE(many(20, 100));
    EXPECT_FALSE(many(20, 101));
    EXPECT_FALSE(many(19, 19));
    const auto nearly_all = [](std::size_t on, std::size_t inside) {
        return HeldInside{{}, on, inside}.nearly_all_on_borders();
    };
    EXPECT_TRUE(nearly_all(20, 40));
    EXPECT_FALSE(nearly_all(20, 41));
    EXPECT_FALSE(nearly_all(19, 19));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
