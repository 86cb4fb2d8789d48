// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/group_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(FacetMeasure, IsAreaOrLength) {
    Mesh mesh = checks::grid(1, 1, 1);
    checks::add_plate(mesh, {5, 0, 0}, {2, 0, 0}, {0, 3, 0}, 1, 1);
    // A tetrahedron of the cube has two faces with an area of 1/2 on it and two of sqrt(2)/2 inside.
    double sum = 0;
    for (std::int8_t face = 1; face <= 4; ++face) sum += facet_measure(mesh, {CellType::tetra, face, 0, 0});
    EXPECT_NEAR(sum, 1 + std::sqrt(2.0), 1e-15);
    // Its sides and edges of a triangle with legs of 2 and 3.
    EXPECT_NEAR(facet_measure(mesh, {CellType::triangle, 1, 0, 0}), 3, 1e-15);
    EXPECT_NEAR(facet_measure(mesh, {CellType::triangle, 2, 0, 0}), 3, 1e-15);
    EXPECT_NEAR(facet_measure(mesh, {CellType::triangle, 3, 0, 0}), 2, 1e-15);
    EXPECT_NEAR(facet_measure(mesh, {CellType::triangle, 4, 0, 0}), 3, 1e-15);
    EXPECT_NEAR(facet_measure(mesh, {CellType::triangle, 5, 0, 0}), std::sqrt(13.0), 1e-15);
    Mesh cube;
    for (int k = 0; k < 8; ++k) cube.add_node(Vec3((k ^ (k >> 1)) & 1, 2 * (k >> 1 & 1), 3 * (k >> 2)), k + 1);
    cube.add_cell(CellType::hexahedron, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7}, 5);
    EXPECT_NEAR(facet_measure(cube, {CellType::hexahedron, 1, 0, 0}), 2, 1e-15) << "the bottom";
}

/// Two cubes; LEFT is the first, CORNERS its node at the origin, SIDE a face of its first element.
struct GroupReport : testing::Test {
    GroupReport() {
        mesh = checks::grid(2, 1, 1);
        left = checks::family_of(mesh, "LEFT", GroupKind::element);
        corners = checks::family_of(mesh, "CORNERS", GroupKind::node);
        side = checks::family_of(mesh, "SIDE", GroupKind::facet);
        mesh.add_group("*HIDDEN", GroupKind::node, true);
        for (Index c = 0; c < 6; ++c) mesh.block(CellType::tetra).families[c] = left;
        mesh.node_families[0] = corners;
        mesh.facets.push_back({CellType::tetra, 1, side, 0});
    }
    Mesh mesh;
    FamilyIndex left = 0, corners = 0, side = 0;
};

TEST_F(GroupReport, CountsMembersByFamily) {
    FamilyTotals totals = family_totals(mesh);
    EXPECT_EQ(totals.by_family[left].cells[3], 6);
    EXPECT_NEAR(totals.by_family[left].measure[3], 1, 1e-15);
    EXPECT_EQ(totals.by_family[0].cells[3], 6);
    EXPECT_EQ(totals.by_family[0].measure[3], 0) << "what is in no group is not measured";
    EXPECT_EQ(totals.by_family[corners].nodes, 1);
    EXPECT_EQ(totals.by_family[side].facets, 1);
    EXPECT_GT(totals.by_family[side].facet_area, 0.49);
    const CellRef two[] = {{CellType::tetra, 0}, {CellType::tetra, 1}};
    count_cells(totals, mesh, two, -1);
    EXPECT_EQ(totals.by_family[left].cells[3], 4);
    EXPECT_NEAR(totals.by_family[left].measure[3], 4.0 / 6, 1e-15);
    count_nodes_and_facets(totals, mesh, +1);
    EXPECT_EQ(totals.by_family[corners].nodes, 2);
    EXPECT_EQ(totals.by_family[side].facets, 2);
    recount_nodes_and_facets(totals, mesh);
    EXPECT_EQ(totals.by_family[corners].nodes, 1);
    EXPECT_EQ(totals.by_family[side].facets, 1);
}

TEST_F(GroupReport, ComparesGroups) {
    Mesh after = mesh;
    const FamilyIndex fresh = checks::family_of(after, "FRESH", GroupKind::node);
    after.node_families[0] = fresh;  // CORNERS becomes empty
    after.points[0].x() = -1;        // LEFT grows
    const auto records = compare_groups(mesh, family_totals(mesh), after, family_totals(after));
    ASSERT_EQ(records.size(), 4u) << "hidden ones are not reported";
    EXPECT_EQ(records[0].name, "LEFT");
    EXPECT_EQ(records[0].status, "changed");
    EXPECT_EQ(records[0].dimension, 3);
    EXPECT_EQ(records[0].count_after, 6);
    EXPECT_NEAR(records[0].measure_before, 1, 1e-15);
    EXPECT_GT(records[0].measure_after, 1.1);
    EXPECT_EQ(records[1].name, "CORNERS");
    EXPECT_EQ(records[1].status, "became empty");
    EXPECT_EQ(records[1].count_before, 1);
    EXPECT_EQ(records[1].count_after, 0);
    EXPECT_EQ(records[2].dimension, 2);
    EXPECT_EQ(records[3].name, "FRESH");
    EXPECT_EQ(records[3].status, "new");
    EXPECT_EQ(records[3].count_before, 0);
    EXPECT_EQ(records[3].count_after, 1);
    for (const GroupRecord& r : compare_groups(mesh, family_totals(mesh), mesh, family_totals(mesh)))
        EXPECT_EQ(r.status, "kept") << r.name;
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
