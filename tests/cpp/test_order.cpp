// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes brought to another order.
#include "mesh/order.h"

#include <gtest/gtest.h>

#include "mesh/middles.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(Order, ThereAndBackIsTheSame) {
    Mesh mesh = checks::two_halves();
    checks::add_plate(mesh, {0, 0, 2}, {1, 0, 0}, {0, 0, 1}, 2, 1);
    const FamilyIndex fixed = checks::family_of(mesh, "FIX", GroupKind::node);
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (mesh.points[n][0] == 0) mesh.node_families[n] = fixed;
    const Mesh second = to_second_order(mesh);
    second.validate();
    EXPECT_FALSE(is_second_order(mesh));
    EXPECT_TRUE(is_second_order(second));
    EXPECT_EQ(second.block(CellType::tetra10).size(), mesh.block(CellType::tetra).size());
    EXPECT_EQ(second.block(CellType::triangle6).size(), mesh.block(CellType::triangle).size());
    const Mesh back = to_first_order(second);
    back.validate();
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.node_ids, mesh.node_ids);
    EXPECT_EQ(back.block(CellType::tetra).connectivity, mesh.block(CellType::tetra).connectivity);
    EXPECT_EQ(checks::members(back, "LEFT", GroupKind::element), checks::members(mesh, "LEFT", GroupKind::element));
    EXPECT_EQ(checks::members(back, "FIX", GroupKind::node), checks::members(mesh, "FIX", GroupKind::node));
}

TEST(Order, MiddlesAreInTheMiddleAndInGroupsOfBothEnds) {
    Mesh mesh = checks::grid(1, 1, 1);
    const FamilyIndex fixed = checks::family_of(mesh, "FIX", GroupKind::node);
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (mesh.points[n][0] == 0) mesh.node_families[n] = fixed;
    const Mesh second = to_second_order(mesh);
    EXPECT_EQ(second.node_count(), 8 + 19);
    const Index middle = checks::number_near(second, {0, 0.5, 0});
    EXPECT_EQ(second.points[middle], Vec3(0, 0.5, 0));
    EXPECT_EQ(second.families.groups(second.node_families[middle]).size(), 1u);
    EXPECT_EQ(second.families.groups(second.node_families[checks::number_near(second, {0.5, 0, 0})]).size(), 0u);
}

TEST(Middles, AreKnownByTheirEdges) {
    const Mesh mesh = to_second_order(checks::grid(1, 1, 1));
    const auto all = middles_of(mesh);
    EXPECT_EQ(all.size(), 19u);
    for (const auto& [key, middle] : all) EXPECT_GE(middle, 8);
    const Index a = checks::number_near(mesh, {0, 0, 0}), b = checks::number_near(mesh, {0, 1, 0});
    EXPECT_EQ(mesh_edge_key(a, b), mesh_edge_key(b, a));
    EXPECT_EQ(mesh.points[all.at(mesh_edge_key(b, a))], Vec3(0, 0.5, 0));
    const auto one = middles_of(mesh, [&](Index i, Index j) { return std::minmax(i, j) == std::minmax(a, b); });
    EXPECT_EQ(one.size(), 1u);
    EXPECT_TRUE(middles_of(checks::grid(1, 1, 1)).empty());
}

TEST(Order, FacetsGoWithTheirElements) {
    Mesh mesh = checks::grid(1, 1, 1);
    const GroupIndex loaded = mesh.add_group("LOADED", GroupKind::facet);
    mesh.facets.push_back({CellType::tetra, 2, mesh.families.with(0, loaded), 3});
    const Mesh second = to_second_order(mesh);
    ASSERT_EQ(second.facets.size(), 1u);
    EXPECT_EQ(second.facets[0].type, CellType::tetra10);
    EXPECT_EQ(second.block(CellType::tetra10).ids[second.facets[0].cell], mesh.block(CellType::tetra).ids[3]);
    EXPECT_EQ(second.facets[0].face, 2);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
