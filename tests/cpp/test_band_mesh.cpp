// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/band_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

/// Two triangles, 0 1 2 and 1 3 2, and the segment 1-2 between them.
struct Lists {
    Lists() {
        triangles.resize_nodes(5);
        triangles.add({0, 1, 2}, 10);
        triangles.add({1, 3, 2}, 11);
        lines.assign({{1, 2}}, 5);
    }
    SimplexList<3> triangles;
    SimplexList<2> lines;
};

TEST(SimplexList, SplitsAtANode) {
    Lists lists;
    lists.triangles.split(1, 2, 4);
    ASSERT_EQ(lists.triangles.size(), 4);
    // The parts with node 1 stay in their places.
    EXPECT_THAT(lists.triangles[0], ElementsAre(0, 1, 4));
    EXPECT_THAT(lists.triangles[1], ElementsAre(1, 3, 4));
    EXPECT_THAT(lists.triangles[2], ElementsAre(0, 4, 2));
    EXPECT_THAT(lists.triangles[3], ElementsAre(4, 3, 2));
    EXPECT_EQ(lists.triangles.origin(2), 0);
    EXPECT_EQ(lists.triangles.tag(2), 10);
    EXPECT_EQ(lists.triangles.origin(3), 1);
    EXPECT_EQ(lists.triangles.tag(3), 11);
    EXPECT_THAT(lists.triangles.around(4), UnorderedElementsAre(0, 1, 2, 3));
    EXPECT_THAT(lists.triangles.around(2), UnorderedElementsAre(2, 3));
    EXPECT_THAT(lists.triangles.around(0), UnorderedElementsAre(0, 2));
    lists.lines.split(1, 2, 4);
    EXPECT_EQ(lists.lines.size(), 2);
    EXPECT_EQ(lists.lines.find({2, 4}), 1);
    EXPECT_EQ(lists.lines.find({1, 2}), -1);
}

TEST(SimplexList, MergesANodeIntoAnother) {
    Lists lists;
    lists.triangles.split(1, 2, 4);
    lists.triangles.merge(4, 0);  // what has both goes, the others get node 0
    EXPECT_FALSE(lists.triangles.alive(0));
    EXPECT_FALSE(lists.triangles.alive(2));
    EXPECT_THAT(lists.triangles[1], ElementsAre(1, 3, 0));
    EXPECT_THAT(lists.triangles[3], ElementsAre(0, 3, 2));
    EXPECT_TRUE(lists.triangles.merged(1));
    EXPECT_TRUE(lists.triangles.merged(3));
    EXPECT_THAT(lists.triangles.around(0), UnorderedElementsAre(1, 3));
    EXPECT_THAT(lists.triangles.around(4), IsEmpty());
    EXPECT_THAT(lists.triangles.around(1), UnorderedElementsAre(1));
}

TEST(SimplexList, RemovesAndFinds) {
    Lists lists;
    EXPECT_EQ(lists.triangles.find({2, 0, 1}), 0);
    EXPECT_EQ(lists.triangles.find({0, 1, 3}), -1);
    lists.triangles.remove(0);
    EXPECT_FALSE(lists.triangles.alive(0));
    EXPECT_EQ(lists.triangles.find({2, 0, 1}), -1);
    EXPECT_THAT(lists.triangles.around(1), ElementsAre(1));
    lists.triangles.set_tag(1, 12);
    EXPECT_EQ(lists.triangles.tag(1), 12);
    EXPECT_FALSE(lists.triangles.merged(1));
}

TEST(BandMesh, HoldsTheElementsOfItsNodes) {
    const Mesh mesh = checks::second_order(checks::grid(3, 1, 1));
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    for (std::size_t n = 0; n < level.size(); ++n)
        if (mesh.points[n].x() == 0) level[n] = 0;
    const BandMesh band = extract_band(mesh, level);
    EXPECT_EQ(band.size(), 8) << "the first cube's corners";
    EXPECT_EQ(band.tetras.size(), 6);
    EXPECT_EQ(band.mid_nodes.size(), 19u);
    for (const BandNode& n : band.nodes) {
        EXPECT_EQ(n.movable(), n.at.x() == 0);
        EXPECT_EQ(n.at, mesh.points[n.global]);
    }
    for (const auto& [key, middle] : band.mid_nodes) {
        const Vec3 &a = band.nodes[static_cast<int>(key >> 32)].at,
                   &b = band.nodes[static_cast<int>(key & 0xffffffffu)].at;
        EXPECT_EQ(mesh.points[middle], (a + b) / 2);
    }
}

TEST(BandMesh, KnowsWhatIsNear) {
    const Mesh mesh = checks::grid(3, 1, 1);
    const BandMesh band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0));
    std::vector<int> near;
    band.neighbours(0, near);
    EXPECT_EQ(near.size(), 7u) << "all nodes of the first cube";
    EXPECT_TRUE(std::ranges::is_sorted(near));
    EXPECT_EQ(band.nodes_near({0}, 0).size(), 1u);
    EXPECT_EQ(band.nodes_near({0}, 1).size(), 8u);
    EXPECT_EQ(band.nodes_near({0}, 2).size(), 12u);
    EXPECT_EQ(edge_key(3, 5), edge_key(5, 3));
    EXPECT_NE(edge_key(3, 5), edge_key(3, 6));
    // Six tetrahedra with three edges each at the corner: two along each axis and two along each face's diagonal, six
    // along the cube's.
    EXPECT_NEAR(band.mean_edge_length(0), (6 + 6 * std::sqrt(2.0) + 6 * std::sqrt(3.0)) / 18, 1e-15);
}

TEST(BandMesh, SplitsInAllLists) {
    Mesh mesh = checks::second_order(checks::grid(1, 1, 1));
    const Index middle = checks::number_near(mesh, {0.5, 0, 0});
    mesh.add_cell(CellType::line,
                  std::array{checks::number_near(mesh, {0, 0, 0}), checks::number_near(mesh, {1, 0, 0})}, 900);
    BandMesh band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0));
    band.cut_faces.add({0, 1, 2}, 4);
    band.cut_edges.add({0, 1}, 4);
    EXPECT_TRUE(band.is_cut_edge(0, 2));
    EXPECT_TRUE(band.is_cut_border(0, 2));
    EXPECT_FALSE(band.is_cut_edge(0, 7));
    band.cut_faces.add({0, 2, 3}, 4);
    EXPECT_FALSE(band.is_cut_border(0, 2)) << "two faces of one tag";
    ASSERT_EQ(band.nodes[1].at, Vec3(1, 0, 0));
    const int born = band.split_edge(0, 1, {0.5, 0, 0});
    EXPECT_TRUE(band.is_new(born));
    EXPECT_EQ(band.original_nodes(), 8);
    EXPECT_EQ(band.nodes[born].global, middle) << "the mid-side node becomes the corner";
    EXPECT_FALSE(band.mid_nodes.contains(edge_key(0, 1)));
    EXPECT_EQ(band.lines.size(), 2);
    EXPECT_EQ(band.cut_faces.size(), 3);
    EXPECT_EQ(band.cut_edges.size(), 2);
    EXPECT_TRUE(band.in_use(born));
    band.merge_node(born, 0);
    EXPECT_FALSE(band.in_use(born));
}

TEST(BandMesh, HoldsFacetsWithTheirNormalsOutwards) {
    Mesh mesh = checks::grid(1, 1, 1);
    const FamilyIndex family = checks::family_of(mesh, "FACES", GroupKind::facet);
    for (std::int8_t face = 1; face <= 4; ++face) mesh.facets.push_back({CellType::tetra, face, family, 2});
    const BandMesh band = extract_band(mesh, std::vector<std::int8_t>(8, 0));
    ASSERT_EQ(band.facet_faces.size(), 4);
    Vec3 centre = Vec3::Zero();
    for (const int v : band.tetras[2]) centre += band.nodes[v].at / 4;
    for (int f = 0; f < 4; ++f) {
        const auto& n = band.facet_faces[f];
        const Vec3 &a = band.nodes[n[0]].at, &b = band.nodes[n[1]].at, &c = band.nodes[n[2]].at;
        EXPECT_GT((b - a).cross(c - a).dot(a - centre), 0);
        EXPECT_EQ(band.facet_faces.tag(f), f);
    }
}

TEST(BandMesh, RefusesOtherElements) {
    Mesh mesh;
    for (int k = 0; k < 4; ++k) mesh.add_node(Vec3((k == 1) + (k == 2), k / 2, 0), k + 1);
    mesh.add_cell(CellType::quad, std::array<Index, 4>{0, 1, 2, 3}, 55);
    const std::vector<std::int8_t> all(4, 0);
    EXPECT_THAT([&] { extract_band(mesh, all); },
                testing::ThrowsMessage<UnsupportedElementError>(testing::HasSubstr("1 quad elements (55)")));
    EXPECT_EQ(extract_band(mesh, all, nullptr, true).size(), 0);
}

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
        if (other) {
            EXPECT_TRUE(band.is_changed(band.tetras, t));
        }
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

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
