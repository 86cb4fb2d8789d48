// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/band_mesh.h"

#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace {

TEST(BandMesh, ElementsThatMergingGaveOtherNodesOfTheInputAreChanged) {
    const Mesh mesh = checks::grid(2, 2, 2);
    BandMesh band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0));
    for (int t = 0; t < band.tetras.size(); ++t) EXPECT_FALSE(band.is_changed(band.tetras, t));
    // The diagonal of the first cube has six tetrahedra around it.
    const auto at = [&](double x, double y, double z) {
        const Index node = checks::number_near(mesh, {x, y, z});
        for (int v = 0; v < band.size(); ++v)
            if (band.nodes[v].global == node) return v;
        return -1;
    };
    const int a = at(0, 0, 0), b = at(1, 1, 1);
    const int p = band.split_edge(a, b, Vec3(0.5, 0.5, 0.5));
    const int split = band.tetras.around(p)[0];
    EXPECT_TRUE(band.is_changed(band.tetras, split));
    band.merge_node(p, at(1, 0, 0));
    // Nothing new and nothing moved is left, but the elements around are others.
    int others = 0;
    for (int t = 0; t < band.tetras.size(); ++t) {
        if (!band.tetras.alive(t)) continue;
        for (const int v : band.tetras[t]) EXPECT_FALSE(band.is_new(v));
        std::vector<Vec3> now, before;
        const CellRef& c = band.tetra_cells[band.tetras.origin(t)];
        for (int k = 0; k < 4; ++k) {
            now.push_back(band.nodes[band.tetras[t][k]].at);
            before.push_back(mesh.points[mesh.block(c.type).connectivity[static_cast<std::size_t>(4 * c.cell + k)]]);
        }
        const bool other = now != before;
        others += other;
        if (other) EXPECT_TRUE(band.is_changed(band.tetras, t));
    }
    EXPECT_GT(others, 0);
}

TEST(BandMesh, FacetsOfOtherElementsThanSimplicesAreLeftOutWithThem) {
    Mesh mesh = checks::grid(1, 1, 1);
    checks::add_plate(mesh, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    std::array<Index, 8> n;
    for (int k = 0; k < 4; ++k) {
        constexpr double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        n[k] = checks::number_near(mesh, {corner[k][0], corner[k][1], 1});
        n[k + 4] = mesh.add_node({corner[k][0], corner[k][1], 2}, mesh.largest_node_id() + 1);
    }
    mesh.add_cell(CellType::hexahedron, n, mesh.largest_cell_id() + 1);
    mesh.add_cell(CellType::quad, std::span(n).last(4), mesh.largest_cell_id() + 1);
    const FamilyIndex family = checks::family_of(mesh, "LOADED", GroupKind::facet);
    mesh.facets = {{CellType::triangle, 2, family, 1},
                   {CellType::tetra, 1, family, 3},
                   {CellType::quad, 2, family, 0},
                   {CellType::quad, 3, family, 0},
                   {CellType::hexahedron, 1, family, 0}};
    const BandMesh band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0), nullptr, true);
    ASSERT_EQ(band.facet_faces.size(), 1);
    EXPECT_EQ(band.facet_faces.tag(0), 1);
    EXPECT_EQ(band.facet_sides, (std::vector<std::pair<int, int>>{{1, 0}}));
    EXPECT_EQ(band.facet_edges.size(), 0);
}

}  // namespace
}  // namespace femscalpel
