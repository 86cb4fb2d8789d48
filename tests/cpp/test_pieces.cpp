// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/pieces.h"

#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// Two boxes of 1 and 3 cubes that do not touch, the large one of higher numbers of nodes.
Mesh two_boxes() {
    Mesh mesh = checks::grid(1, 1, 1);
    const Mesh other = checks::grid(3, 1, 1);
    const Index first = mesh.node_count();
    for (Index n = 0; n < other.node_count(); ++n)
        mesh.add_node(other.points[n] + Vec3(5, 0, 0), mesh.largest_node_id() + 1);
    const CellBlock& cells = other.block(CellType::tetra);
    for (Index c = 0; c < cells.size(); ++c) {
        std::vector<Index> nodes(cells.nodes(c).begin(), cells.nodes(c).end());
        for (Index& n : nodes) n += first;
        mesh.add_cell(CellType::tetra, nodes, mesh.largest_cell_id() + 1);
    }
    return mesh;
}

TEST(Pieces, OfOneBodyAndOfNothing) {
    const std::vector<Piece> one = find_pieces(checks::grid(2, 2, 1));
    ASSERT_EQ(one.size(), 1U);
    EXPECT_EQ(one[0].elements.size(), 24U);
    EXPECT_EQ(one[0].dimension, 3);
    EXPECT_NEAR(one[0].measure, 4, 1e-12);
    EXPECT_NEAR((one[0].place - Vec3(1, 1, 0.5)).norm(), 0, 1e-12);
    EXPECT_EQ(one[0].nodes.size(), 18U);
    EXPECT_TRUE(std::is_sorted(one[0].nodes.begin(), one[0].nodes.end()));
    EXPECT_TRUE(find_pieces(Mesh()).empty());
}

TEST(Pieces, LargestFirst) {
    const Mesh mesh = two_boxes();
    const std::vector<Piece> found = find_pieces(mesh);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0].measure, 3, 1e-12);
    EXPECT_NEAR(found[1].measure, 1, 1e-12);
    EXPECT_NEAR((found[0].place - Vec3(6.5, 0.5, 0.5)).norm(), 0, 1e-12);
    EXPECT_EQ(found[1].elements.size(), 6U);
    for (Index n = 0; n < mesh.node_count(); ++n) {
        const std::vector<Index>& nodes = found[mesh.points[n].x() > 3 ? 0 : 1].nodes;
        EXPECT_TRUE(std::binary_search(nodes.begin(), nodes.end(), mesh.node_ids[n]));
    }
    EXPECT_EQ(found[0].nodes.size() + found[1].nodes.size(), mesh.points.size());
}

TEST(Pieces, SegmentsJoinPointsAndLooseNodesDoNot) {
    Mesh mesh = two_boxes();
    const Index loose = mesh.add_node({9, 9, 9}, 900, checks::family_of(mesh, "ALONE", GroupKind::node));
    mesh.add_cell(CellType::vertex, std::vector<Index>{loose}, 900,
                  checks::family_of(mesh, "POINT", GroupKind::element));
    mesh.add_cell(CellType::vertex, std::vector<Index>{0}, 901);
    std::vector<Piece> found = find_pieces(mesh);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].nodes.size() + found[1].nodes.size() + 1, mesh.points.size());
    EXPECT_EQ(found[1].elements.size(), 6U) << "points do not count";
    EXPECT_TRUE(found[0].groups.empty());
    // A spring between the boxes, then one away from both.
    mesh.add_cell(CellType::line, std::vector<Index>{0, loose - 1}, 902);
    found = find_pieces(mesh);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].measure, 4, 1e-12) << "the spring has no volume";
    EXPECT_EQ(found[0].elements.size(), 25U);
    const Index end = mesh.add_node({9, 9, 11}, 901);
    mesh.add_cell(CellType::line, std::vector<Index>{loose, end}, 903);
    found = find_pieces(mesh);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[1].dimension, 1);
    EXPECT_NEAR(found[1].measure, 2, 1e-12);
    EXPECT_EQ(found[1].groups.size(), 2U) << "of its node and its point";
}

TEST(Pieces, HaveTheGroupsOfNodesElementsAndFacets) {
    Mesh mesh = two_boxes();
    mesh.node_families[0] = checks::family_of(mesh, "HELD", GroupKind::node);
    mesh.block(CellType::tetra).families.back() = checks::family_of(mesh, "LAST", GroupKind::element);
    mesh.facets.push_back({CellType::tetra, 1, checks::family_of(mesh, "LOADED", GroupKind::facet), 0});
    const GroupIndex hidden = mesh.add_group("HIDDEN", GroupKind::element, true);
    mesh.block(CellType::tetra).families[1] = mesh.families.intern(std::vector<GroupIndex>{hidden});
    const std::vector<Piece> found = find_pieces(mesh);
    const auto index = [&](const char* name) { return *mesh.find_group(name); };
    EXPECT_EQ(found[0].groups, std::vector<GroupIndex>{index("LAST")});
    EXPECT_EQ(found[1].groups, (std::vector<GroupIndex>{index("HELD"), index("LOADED")}));
}

TEST(Pieces, DoubleNodesPartAndElementsWithoutSizeHaveAPlace) {
    EXPECT_EQ(find_pieces(checks::touching_tetrahedra()).size(), 2U);
    Mesh mesh;
    for (Index n = 0; n < 3; ++n) mesh.add_node({4, 5, 6}, n + 1);
    mesh.add_cell(CellType::triangle, std::vector<Index>{0, 1, 2}, 1);
    const std::vector<Piece> found = find_pieces(mesh);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].measure, 0);
    EXPECT_EQ(found[0].place, Vec3(4, 5, 6));
}

TEST(Pieces, AfterAChangeOfAPart) {
    // Four cubes in a row; the second and the third get nodes of their own between them.
    Mesh mesh = checks::grid(4, 1, 1);
    const auto row_of = [&](const Mesh& m, CellType type, Index c) {
        double x = 0;
        for (const Index n : m.block(type).nodes(c)) x += m.points[n].x() / traits(type).nodes;
        return static_cast<int>(x);
    };
    const FamilyIndex end = checks::family_of(mesh, "END", GroupKind::node);
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (mesh.points[n].x() == 4) mesh.node_families[n] = end;
    Mesh changed;
    std::vector<Index> third;
    const CellBlock& cells = mesh.block(CellType::tetra);
    const FamilyIndex known = checks::family_of(changed, "END", GroupKind::node),
                      unknown = checks::family_of(changed, "NEW", GroupKind::node);
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (mesh.points[n].x() >= 1 && mesh.points[n].x() <= 3) changed.add_node(mesh.points[n], mesh.node_ids[n]);
    const auto node = [&](const Vec3& at, bool doubled) {
        for (Index n = changed.node_count() - 1; n >= 0; --n)
            if (changed.points[n] == at && (changed.node_ids[n] > 1000) == doubled) return n;
        return changed.add_node(at, 1000 + changed.node_count(), doubled ? unknown : known);
    };
    for (Index c = 0; c < cells.size(); ++c) {
        const int row = row_of(mesh, CellType::tetra, c);
        if (row == 2) third.push_back(cells.ids[c]);
        if (row != 1 && row != 2) continue;
        std::vector<Index> nodes;
        for (const Index n : cells.nodes(c)) nodes.push_back(node(mesh.points[n], row == 2 && mesh.points[n].x() == 2));
        changed.add_cell(CellType::tetra, nodes, cells.ids[c]);
    }
    EXPECT_EQ(find_pieces(mesh).size(), 1U);
    const std::vector<Piece> found = find_pieces(mesh, changed, {});
    ASSERT_EQ(found.size(), 2U);
    for (const Piece& piece : found) {
        EXPECT_NEAR(piece.measure, 2, 1e-12);
        EXPECT_EQ(piece.elements.size(), 12U);
        EXPECT_EQ(piece.nodes.size(), 12U);
        EXPECT_EQ(piece.nodes.back() > 1000, piece.place.x() > 2);
        EXPECT_EQ(piece.groups.size(), piece.place.x() > 2 ? 1U : 0U) << "NEW is no group of the mesh";
    }
    // Without the elements of the third: the changed part as it is where these are gone.
    Mesh rest = changed;
    rest.block(CellType::tetra) = Mesh().block(CellType::tetra);
    const std::vector<Piece> less = find_pieces(mesh, rest, third);
    ASSERT_EQ(less.size(), 2U);
    EXPECT_NEAR(less[0].measure, 2, 1e-12);
    EXPECT_NEAR(less[1].measure, 1, 1e-12);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
