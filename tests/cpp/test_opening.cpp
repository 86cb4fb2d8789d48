// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/opening.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cutting/node_parts.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

const Plane plane({1, 0, 0}, {1, 0, 0});

Vec3 place(const Workpiece& f, const Opening& opening, int v) {
    const int size = f.d.band.size();
    return f.d.band.nodes[v < size ? v : opening.copy_of[v - size]].at;
}

/// Middle of an element of the band.
template <std::size_t N>
Vec3 middle(const Workpiece& f, const std::array<int, N>& nodes) {
    Vec3 sum = Vec3::Zero();
    for (const int v : nodes) sum += f.d.band.nodes[v].at;
    return sum / static_cast<double>(N);
}

/// Elements on the negative side keep their nodes, those on the other have copies of all that are doubled.
template <class List>
void expect_copies_on_the_positive_side(const Workpiece& f, const Opening& opening, const List& list,
                                        const auto& opened) {
    const std::set<int> doubled(opening.copy_of.begin(), opening.copy_of.end());
    for (int s = 0; s < list.size(); ++s)
        for (std::size_t k = 0; k < list[s].size(); ++k) {
            const bool copied = opened[s][k] != list[s][k];
            const bool positive = plane.distance(middle(f, list[s])) > 0;
            EXPECT_EQ(copied, positive && doubled.contains(list[s][k])) << "element " << s;
            if (copied) {
                EXPECT_EQ(opening.copy_of[opened[s][k] - f.d.band.size()], list[s][k]);
            }
        }
}

TEST(Opening, PartsASolidAtAPlane) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Opening opening = open_lips(f);
    EXPECT_EQ(opening.interface_nodes.size(), 9u);
    EXPECT_THAT(opening.copy_of, testing::UnorderedElementsAreArray(opening.interface_nodes));
    EXPECT_THAT(opening.front_nodes, IsEmpty());
    EXPECT_THAT(opening.warnings, IsEmpty());
    EXPECT_FALSE(opening.removes);
    expect_copies_on_the_positive_side(f, opening, f.d.band.tetras, opening.tetras);
    // Two lips of 2 x 2 squares, each seen from outside.
    std::array<Vec3, 2> area{Vec3::Zero(), Vec3::Zero()};
    for (const auto& face : opening.faces) {
        const Vec3 a = place(f, opening, face.nodes[0]), b = place(f, opening, face.nodes[1]),
                   c = place(f, opening, face.nodes[2]);
        area[face.group] += (b - a).cross(c - a) / 2;
        EXPECT_EQ(face.element, Opening::fresh);
        EXPECT_FALSE(face.second_order);
        for (const int v : face.nodes) EXPECT_EQ(v >= f.d.band.size(), face.group == 1);
    }
    EXPECT_EQ(opening.faces.size(), 16u);
    EXPECT_LT((area[0] - Vec3(4, 0, 0)).norm(), 1e-12);
    EXPECT_LT((area[1] + Vec3(4, 0, 0)).norm(), 1e-12);
}

TEST(Opening, EndsAtAFrontWhereOnlyCutFacesOpen) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, plane);
    f.patched = true;
    BandMesh& band = f.d.band;
    for (const auto& face : open_lips(checks::whole_workpiece(mesh, plane)).faces)
        if (face.group == 0 && middle(f, face.nodes).y() < 1) band.cut_faces.add(face.nodes, 0);
    ASSERT_EQ(band.cut_faces.size(), 4);
    const Opening opening = open_lips(f);
    const auto at = [&](double y, double z) { return node_at(band, {1, y, z}); };
    EXPECT_THAT(opening.copy_of, UnorderedElementsAre(at(0, 0), at(0, 1), at(0, 2)));
    EXPECT_THAT(opening.front_nodes, UnorderedElementsAre(at(1, 0), at(1, 1), at(1, 2)));
    ASSERT_EQ(opening.front_chains.size(), 1u);
    EXPECT_THAT(opening.front_chains[0], testing::AnyOf(testing::ElementsAre(at(1, 0), at(1, 1), at(1, 2)),
                                                        testing::ElementsAre(at(1, 2), at(1, 1), at(1, 0))));
    EXPECT_EQ(opening.faces.size(), 8u);
}

TEST(Opening, DoublesTrianglesThatLieThere) {
    Mesh mesh = checks::grid(2, 2, 2);
    const auto node = [&](double y, double z) { return checks::number_near(mesh, {1, y, z}); };
    // Two faces of tetrahedra, on the tool.
    const Workpiece bare = checks::whole_workpiece(mesh, plane);
    const Opening before = open_lips(bare);
    for (int k = 0; k < 2; ++k) {
        std::array<Index, 3> nodes;
        for (int i = 0; i < 3; ++i) nodes[i] = bare.d.band.nodes[before.faces[2 * k].nodes[i]].global;
        mesh.add_cell(CellType::triangle, nodes, 1000 + k);
    }
    // And one edge of them.
    mesh.add_cell(CellType::line, std::array{node(0, 0), node(0, 1)}, 1010);
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Opening opening = open_lips(f);
    ASSERT_EQ(opening.triangle_twins.size(), 2u);
    EXPECT_EQ(opening.line_twins.size(), 1u);
    int old = 0, twins = 0;
    for (const auto& face : opening.faces) {
        if (face.element == Opening::fresh) continue;
        (face.element >= 0 ? old : twins) += 1;
        EXPECT_EQ(face.group, face.element < 0) << "the original stays on the negative lip";
        const auto& nodes =
            face.element >= 0 ? opening.triangles[face.element] : opening.triangle_twins[-1 - face.element].nodes;
        EXPECT_TRUE(std::ranges::is_permutation(nodes, face.nodes));
    }
    EXPECT_EQ(old, 2);
    EXPECT_EQ(twins, 2);
}

TEST(Opening, LeavesBeamsOnTheirSidesAndMassesWhole) {
    Mesh mesh = checks::grid(2, 2, 2);
    const auto number = [&](double x, double y, double z) { return checks::number_near(mesh, {x, y, z}); };
    const Index left = mesh.add_node({0.5, 1, 4}, 5000), right = mesh.add_node({1.5, 1, 4}, 5001);
    mesh.add_cell(CellType::line, std::array{number(1, 1, 2), left}, 2000);
    mesh.add_cell(CellType::line, std::array{number(1, 1, 2), right}, 2001);
    mesh.add_cell(CellType::vertex, std::array{number(1, 2, 0)}, 2002);
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Opening opening = open_lips(f);
    const BandMesh& band = f.d.band;
    const int top = node_at(band, {1, 1, 2});
    ASSERT_EQ(band.lines.size(), 2);
    for (int l = 0; l < 2; ++l) {
        const bool positive = middle(f, band.lines[l]).x() > 1;
        const int end = opening.lines[l][band.lines[l][0] == top ? 0 : 1];
        EXPECT_EQ(end == top, !positive);
        EXPECT_EQ(place(f, opening, end), Vec3(1, 1, 2));
    }
    EXPECT_THAT(opening.line_twins, IsEmpty());
    EXPECT_THAT(opening.warnings, testing::ElementsAre(HasSubstr("1 point element (mass, spring to ground)")));
}

TEST(Opening, PartsAPlateAtALine) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Opening opening = open_lips(f);
    EXPECT_EQ(opening.copy_of.size(), 3u);
    expect_copies_on_the_positive_side(f, opening, f.d.band.triangles, opening.triangles);
    EXPECT_THAT(opening.faces, IsEmpty());
    EXPECT_EQ(opening.edges.size(), 4u);
    EXPECT_EQ(std::ranges::count(opening.edges, 1, &Opening::Face<2>::group), 2);
}

TEST(Opening, OfAPlateThatOthersStandOnLeavesThatWhole) {
    // A plate in the tool's plane, with one standing on its negative side: the crack parts them.
    Mesh mesh;
    checks::add_plate(mesh, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2, 2);
    checks::add_plate(mesh, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, 2);
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Opening opening = open_lips(f);
    EXPECT_THAT(opening.copy_of, UnorderedElementsAre(node_at(f.d.band, {1, 0, 1}), node_at(f.d.band, {1, 1, 1}),
                                                      node_at(f.d.band, {1, 2, 1})));
    EXPECT_THAT(
        opening.warnings,
        testing::ElementsAre(HasSubstr("8 shell elements lie in the tool's surface, and stay on the positive side")));
}

TEST(Opening, CanBeNone) {
    const Mesh mesh = checks::grid(1, 1, 1);
    const Workpiece f = checks::whole_workpiece(mesh, plane);
    const Opening opening = no_opening(f.d.band);
    ASSERT_EQ(opening.tetras.size(), 6u);
    for (int t = 0; t < 6; ++t) EXPECT_EQ(opening.tetras[t], f.d.band.tetras[t]);
    EXPECT_THAT(opening.copy_of, IsEmpty());
    EXPECT_THAT(opening.faces, IsEmpty());
}

TEST(NodeParts, LargestOnTheNegativeSideKeepsTheNode) {
    NodeParts parts(7);
    // Negative: 0 and 3, 1 alone; positive: 2, 4 and 5; 6 hangs on in the node alone.
    for (int i = 0; i < 7; ++i) parts.describe(i, i == 2 || i >= 4 ? 1 : -1, i != 6);
    parts.unite(3, 0);
    parts.unite(5, 4);
    parts.unite(2, 5);
    parts.sum_up();
    EXPECT_EQ(parts.keeper(), 0);
    EXPECT_THAT(parts.parted(), testing::ElementsAre(std::pair(1, false), std::pair(2, true)));
    EXPECT_EQ(parts.goes_with(3), 0);
    EXPECT_EQ(parts.goes_with(1), 1);
    EXPECT_EQ(parts.goes_with(4), 2);
    EXPECT_EQ(parts.goes_with(6), 2) << "with the largest part of its side";
}

TEST(NodeParts, WithoutOneOnTheNegativeSideTheLargestKeepsIt) {
    NodeParts parts(4);
    for (int i = 0; i < 4; ++i) parts.describe(i, 1, i < 3);
    parts.unite(1, 2);
    parts.sum_up();
    EXPECT_EQ(parts.keeper(), 1);
    EXPECT_THAT(parts.parted(), testing::ElementsAre(std::pair(0, true)));
}

TEST(NodeParts, ThatAllHangOnInTheNodeAloneStayTogether) {
    NodeParts parts(2);
    parts.describe(0, 1, false);
    parts.describe(1, -1, false);
    parts.sum_up();
    EXPECT_EQ(parts.keeper(), -1);
    EXPECT_THAT(parts.parted(), IsEmpty());
    EXPECT_EQ(parts.goes_with(0), -1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
