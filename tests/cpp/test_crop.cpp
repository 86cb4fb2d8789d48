// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/crop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;

TEST(Crop, TakesElementsWithTheirNodesAndFacets) {
    Mesh mesh;
    mesh.name = "plate";
    mesh.unit = "mm";
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 1);  // triangles 1 to 4
    const GroupIndex empty = mesh.add_group("EMPTY", GroupKind::node);
    const FamilyIndex edges = checks::family_of(mesh, "EDGES", GroupKind::facet),
                      corner = checks::family_of(mesh, "CORNER", GroupKind::node);
    const Index at = checks::number_near(mesh, {2, 1, 0});
    mesh.node_families[at] = corner;
    for (const Index cell : {0, 2, 3}) mesh.facets.push_back({CellType::triangle, 3, edges, cell});
    CellLists cells;
    cells[static_cast<int>(CellType::triangle)] = {2, 3};
    const Crop part = crop(mesh, cells);
    part.mesh.validate();
    EXPECT_EQ(part.mesh.name, "plate");
    EXPECT_EQ(part.mesh.unit, "mm");
    EXPECT_THAT(part.mesh.block(CellType::triangle).ids, ElementsAre(3, 4));
    ASSERT_EQ(part.nodes.size(), 4u);
    for (std::size_t n = 0; n < 4; ++n) {
        if (n > 0) {
            EXPECT_GT(part.nodes[n], part.nodes[n - 1]);
        }
        EXPECT_EQ(part.mesh.points[n], mesh.points[part.nodes[n]]);
        EXPECT_EQ(part.mesh.node_ids[n], mesh.node_ids[part.nodes[n]]);
        EXPECT_EQ(part.mesh.node_families[n], part.nodes[n] == at ? corner : 0);
    }
    for (Index c = 0; c < 2; ++c)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(part.mesh.points[part.mesh.block(CellType::triangle).nodes(c)[k]],
                      mesh.points[mesh.block(CellType::triangle).nodes(c + 2)[k]]);
    ASSERT_EQ(part.mesh.facets.size(), 2u);
    EXPECT_EQ(part.mesh.facets[0].cell, 0);
    EXPECT_EQ(part.mesh.facets[1].cell, 1);
    EXPECT_EQ(part.mesh.groups[empty].name, "EMPTY") << "groups stay, also empty ones";
}

TEST(Crop, TheChangedPartIsWhatIsNewOrMoved) {
    Mesh before;
    checks::add_plate(before, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 1);  // triangles 1 to 6
    Mesh after = before;
    EXPECT_EQ(changed_part(before, after).cell_count(), 0);
    after.points[checks::number_near(after, {0, 0, 0})][2] = 0.1;
    const auto corner = after.block(CellType::triangle).nodes(5);
    after.add_cell(CellType::triangle, std::vector<Index>(corner.begin(), corner.end()), 9);
    const Mesh part = changed_part(before, after);
    EXPECT_THAT(part.block(CellType::triangle).ids, testing::Contains(9));
    EXPECT_LT(part.cell_count(), 4);
    EXPECT_GT(part.cell_count(), 1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
