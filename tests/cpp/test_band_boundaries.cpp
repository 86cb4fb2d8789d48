// SPDX-License-Identifier: LGPL-2.1-or-later
// Boundaries of groups in bands of a few elements. Random ones are in test_groups.cpp.
#include "groups/band_boundaries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::number_near;
using testing::ElementsAre;
using testing::IsEmpty;

BandMesh whole(const Mesh& mesh) { return extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0)); }

/// Two cubes of six tetrahedra side by side in x; the element groups LEFT (0) and RIGHT (1).
Mesh two_cubes() {
    Mesh mesh = checks::grid(2, 1, 1);
    const FamilyIndex left = checks::family_of(mesh, "LEFT", GroupKind::element),
                      right = checks::family_of(mesh, "RIGHT", GroupKind::element);
    CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c) tetras.families[c] = c < 6 ? left : right;
    return mesh;
}

std::vector<GroupIndex> groups(const BandBoundaries& b, int kind) {
    return {b.groups(kind).begin(), b.groups(kind).end()};
}

/// Number of faces through the material and of the skin, by their groups.
using Counts = std::map<std::vector<GroupIndex>, int>;
Counts count(const BandBoundaries& b, bool internal) {
    Counts out;
    for (const auto& f : b.faces())
        if (f.is_internal() == internal) ++out[groups(b, f.kind)];
    return out;
}

TEST(BandBoundaries, ElementGroupsEndWhereTheyDiffer) {
    const Mesh mesh = two_cubes();
    const BandMesh band = whole(mesh);
    const BandBoundaries b(band, mesh);
    EXPECT_EQ(count(b, true), (Counts{{{0, 1}, 2}}));
    EXPECT_EQ(count(b, false), (Counts{{{0}, 10}, {{1}, 10}}));
    for (const auto& f : b.faces()) {
        EXPECT_FALSE(f.element || f.is_shell());
        const auto at = [&](int k) { return band.nodes[f.nodes[k]].at; };
        const auto& behind = band.tetras[f.tetra[0]];
        const Vec3 centre = (band.nodes[behind[0]].at + band.nodes[behind[1]].at + band.nodes[behind[2]].at +
                             band.nodes[behind[3]].at) /
                            4;
        EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).dot(at(0) - centre), 0) << "out of the first tetrahedron";
    }
    EXPECT_THAT(b.lines(), IsEmpty());
    EXPECT_THAT(b.isolated(), IsEmpty());
}

TEST(BandBoundaries, GroupsThatDriftCountForNothing) {
    Mesh mesh = two_cubes();
    const BandMesh band = whole(mesh);
    EXPECT_EQ(count(BandBoundaries(band, mesh, {true, false}), true), (Counts{{{1}, 2}}));
    EXPECT_EQ(count(BandBoundaries(band, mesh, {true, true}), true), Counts{});
    EXPECT_EQ(count(BandBoundaries(band, mesh, {true, true}), false), (Counts{{{}, 20}}));
    mesh.groups[1].hidden = true;
    EXPECT_EQ(count(BandBoundaries(band, mesh), true), (Counts{{{0}, 2}}));
}

TEST(BandBoundaries, TrianglesOnFacesAreKeptUnlessTheirGroupsDrift) {
    Mesh mesh = checks::grid(2, 1, 1);
    const FamilyIndex inside = checks::family_of(mesh, "INSIDE", GroupKind::element);
    checks::add_plate(mesh, {1, 0, 0}, Vec3::UnitY(), Vec3::UnitZ(), 1, 1, inside);
    const BandMesh band = whole(mesh);
    const auto elements = [&](const BandBoundaries& b) {
        return std::ranges::count_if(b.faces(), [](const auto& f) { return f.is_internal() && f.element; });
    };
    const BandBoundaries b(band, mesh);
    EXPECT_EQ(elements(b), 2);
    EXPECT_EQ(count(b, true), (Counts{{{0}, 2}}));
    EXPECT_EQ(elements(BandBoundaries(band, mesh, {true})), 0) << "in a group that drifts alone";
    EXPECT_EQ(elements(BandBoundaries(band, mesh, {true}, {}, {true})), 2) << "as in no group";
    for (FamilyIndex& f : mesh.block(CellType::triangle).families) f = 0;
    EXPECT_EQ(elements(BandBoundaries(band, mesh)), 2) << "in no group";
}

TEST(BandBoundaries, ShellsOnTheSameNodesAreOneFace) {
    Mesh mesh;
    const FamilyIndex one = checks::family_of(mesh, "ONE", GroupKind::element),
                      two = checks::family_of(mesh, "TWO", GroupKind::element);
    checks::add_plate(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1, one);
    checks::add_plate(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1, two);
    const BandMesh band = whole(mesh);
    ASSERT_EQ(band.triangles.size(), 4);
    const BandBoundaries b(band, mesh);
    ASSERT_EQ(b.faces().size(), 2u);
    for (const auto& f : b.faces()) {
        EXPECT_TRUE(f.is_shell() && f.element);
        EXPECT_THAT(groups(b, f.kind), ElementsAre(0, 1));
    }
}

TEST(BandBoundaries, SegmentsAreLines) {
    Mesh mesh = checks::grid(1, 1, 1);
    const FamilyIndex rod = checks::family_of(mesh, "ROD", GroupKind::element);
    mesh.add_cell(CellType::line, std::array{number_near(mesh, {0, 0, 0}), number_near(mesh, {1, 1, 1})}, 5000, rod);
    const BandMesh band = whole(mesh);
    const BandBoundaries b(band, mesh);
    ASSERT_EQ(b.lines().size(), 1u);
    EXPECT_TRUE(b.lines()[0].element);
    EXPECT_THAT(groups(b, b.lines()[0].kind), ElementsAre(0));
    EXPECT_THAT(BandBoundaries(band, mesh, {true}).lines(), IsEmpty());
}

TEST(BandBoundaries, NodeGroupsOnTheSkinHaveItsFaces) {
    Mesh mesh = checks::grid(2, 2, 1);
    const FamilyIndex top = checks::family_of(mesh, "TOP", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.points[n][2] > 0.5) mesh.node_families[n] = top;
    const BandMesh band = whole(mesh);
    const BandBoundaries b(band, mesh);
    EXPECT_EQ(count(b, false), (Counts{{{}, 24}, {{0}, 8}}));
    EXPECT_EQ(count(b, true), Counts{});
    EXPECT_THAT(b.lines(), IsEmpty()) << "the faces hold all edges";
    EXPECT_THAT(b.isolated(), IsEmpty());
    EXPECT_THAT(b.shortcuts(), IsEmpty());
}

TEST(BandBoundaries, NodesWithoutANeighbourInTheirGroupAreIsolated) {
    Mesh mesh = checks::second_order(checks::grid(2, 1, 1));
    const FamilyIndex ends = checks::family_of(mesh, "ENDS", GroupKind::node),
                      middle = checks::family_of(mesh, "MIDDLE", GroupKind::node);
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(2, 1, 0)}) mesh.node_families[number_near(mesh, x)] = ends;
    mesh.node_families[number_near(mesh, {1, 0.5, 1})] = middle;
    const BandMesh band = whole(mesh);
    const BandBoundaries b(band, mesh);
    std::map<std::array<double, 3>, std::vector<GroupIndex>> found;
    for (const auto& n : b.isolated()) {
        const Vec3& at = band.nodes[n.node].at;
        found[{at[0], at[1], at[2]}] = groups(b, n.kind);
    }
    EXPECT_EQ(found, (decltype(found){{{0, 0, 0}, {0}}, {{2, 1, 0}, {0}}, {{1, 0, 1}, {1}}, {{1, 1, 1}, {1}}}));
    ASSERT_EQ(b.isolated_middles().size(), 1u);
    const auto [from, to] = b.isolated_middles()[0];
    EXPECT_EQ((band.nodes[from].at + band.nodes[to].at) / 2, Vec3(1, 0.5, 1));
}

TEST(BandBoundaries, OuterNodesAreLeftOut) {
    const Mesh mesh = two_cubes();
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    level[number_near(mesh, {0, 0, 0})] = 0;
    const BandMesh band = extract_band(mesh, level);
    const BandBoundaries b(band, mesh);
    EXPECT_EQ(count(b, true), Counts{}) << "the border of the groups has no movable node";
    for (const auto& f : b.faces())
        EXPECT_TRUE(std::ranges::any_of(f.nodes, [&](int v) { return band.nodes[v].movable(); }));
    EXPECT_EQ(count(b, false), (Counts{{{0}, 6}})) << "two triangles of each side of the cube at the node";
}

TEST(BandBoundaries, NodesBornOnShortcutsCountAsOnKeptFaces) {
    // Two tetrahedra with a common face, all of whose nodes are in a group: through the material, so it is kept.
    Mesh mesh;
    const FamilyIndex family = checks::family_of(mesh, "FACE", GroupKind::node);
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) mesh.add_node(p, mesh.node_count() + 1, family);
    for (const Vec3& p : {Vec3(0.3, 0.3, 1), Vec3(0.3, 0.3, -1)}) mesh.add_node(p, mesh.node_count() + 1);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 1);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 2, 1, 4}, 2);
    const BandMesh band = whole(mesh);
    const BandBoundaries kept(band, mesh);
    EXPECT_EQ(count(kept, true), (Counts{{{0}, 1}}));
    EXPECT_THAT(kept.shortcuts(), IsEmpty());
    const std::vector<Index> numbers{1, 2, 3};
    const BandBoundaries not_kept(band, mesh, {}, numbers);
    EXPECT_EQ(count(not_kept, true), Counts{});
    ASSERT_EQ(not_kept.shortcuts().size(), 1u);
    EXPECT_THAT(groups(not_kept, not_kept.shortcuts()[0].kind), ElementsAre(0));
    EXPECT_EQ(count(BandBoundaries(band, mesh, {}, std::vector<Index>{1, 2}), true), (Counts{{{0}, 1}}));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
