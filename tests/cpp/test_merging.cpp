// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes moved onto neighbours (as improve() uses it, see test_improve.cpp).
#include "cutting/merging.h"

#include <gtest/gtest.h>

#include <set>

#include "cutting/numbering.h"
#include "cutting/rebuild.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;

TEST(Merging, GoesWhereElementsGetBetter) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    const int middle = node_at(f.d.band, {1, 1, 1});
    const int born = f.split_edge(middle, node_at(f.d.band, {2, 1, 1}), Vec3(1.05, 1, 1), {});
    EXPECT_TRUE(in_one(f.d.band.tetras, born, middle));
    EXPECT_EQ(NodeMerger(f).merge(born), middle);
    EXPECT_FALSE(f.d.band.in_use(born));
}

TEST(Merging, StaysWhereElementsWouldNot) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    EXPECT_EQ(NodeMerger(f).merge(node_at(f.d.band, {1, 1, 1})), -1);
    EXPECT_EQ(NodeMerger(f).merge(node_at(f.d.band, {2, 2, 2})), -1) << "a corner of the skin";
}

/// A plate of second order whose first node group, ALL, has all its nodes; beside it PART has some of them.
Mesh plate_of_second_order() {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 3);
    mesh = checks::second_order(mesh);
    const FamilyIndex all = checks::family_of(mesh, "ALL", GroupKind::node);
    for (FamilyIndex& f : mesh.node_families) f = all;
    return mesh;
}

/// Two nodes born side by side, on edges of one triangle.
struct TwoBorn {
    Mesh mesh = plate_of_second_order();
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    int corner = node_at(f.d.band, {1, 1, 0});
    int first = f.split_edge(corner, node_at(f.d.band, {2, 1, 0}), Vec3(1.1, 1, 0), {});
    int second = f.split_edge(corner, node_at(f.d.band, {1, 2, 0}), Vec3(1, 1.1, 0), {});
    Index middle = f.d.band.nodes[second].global;
};

TEST(Merging, HandsTheMidSideNodeThatBecameACornerOver) {
    TwoBorn two;
    BandMesh& band = two.f.d.band;
    ASSERT_GE(two.middle, 0);
    const Vec3 was = two.mesh.points[two.middle];
    ASSERT_GE(NodeMerger(two.f).merge(two.second), 0);
    EXPECT_EQ(band.nodes[two.second].global, -1);
    int edges = 0;
    for (const auto& [key, node] : band.mid_nodes) {
        if (node != two.middle) continue;
        ++edges;
        EXPECT_TRUE(band.is_handed_over(static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffU)));
    }
    ASSERT_EQ(edges, 1);
    const Rebuilt rebuilt = rebuild(two.mesh, two.mesh, two.f, no_opening(band), {}, next_numbers(two.mesh));
    // All nodes of the input are still those of elements, and each mid-side node is in the middle of its edge.
    std::set<Index> used;
    const CellBlock& block = rebuilt.mesh.block(CellType::triangle6);
    for (Index c = 0; c < block.size(); ++c) {
        const auto n = block.nodes(c);
        used.insert(n.begin(), n.end());
        for (const std::size_t k : {0U, 1U, 2U})
            EXPECT_LT(
                (rebuilt.mesh.points[n[3 + k]] - (rebuilt.mesh.points[n[k]] + rebuilt.mesh.points[n[(k + 1) % 3]]) / 2)
                    .norm(),
                1e-12);
    }
    EXPECT_EQ(static_cast<Index>(used.size()), rebuilt.mesh.node_count());
    EXPECT_NE(rebuilt.mesh.points[two.middle], was);
    EXPECT_EQ(static_cast<Index>(checks::members(rebuilt.mesh, "ALL", GroupKind::node).size()),
              rebuilt.mesh.node_count());
}

TEST(Merging, KeepsAMidSideNodeInItsGroup) {
    TwoBorn two;
    Mesh mesh = two.mesh;
    const GroupIndex part = mesh.add_group("PART", GroupKind::node);
    // An edge of the group from end to end: its corners and its mid-side node.
    for (const Vec3& at : {Vec3(1, 1, 0), Vec3(1, 1.5, 0), Vec3(1, 2, 0)}) {
        FamilyIndex& family = mesh.node_families[checks::number_near(mesh, at)];
        family = mesh.families.with(family, part);
    }
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    const int corner = node_at(f.d.band, {1, 1, 0});
    f.split_edge(corner, node_at(f.d.band, {2, 1, 0}), Vec3(1.1, 1, 0), {});
    const int second = f.split_edge(corner, node_at(f.d.band, {1, 2, 0}), Vec3(1, 1.1, 0), {});
    EXPECT_EQ(NodeMerger(f).merge(second), -1) << "no edge of a new node has both ends in PART";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
