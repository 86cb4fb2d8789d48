// SPDX-License-Identifier: LGPL-2.1-or-later
// Elements that relaxing alone leaves poor: what is merged and bisected, and what is left alone.
#include "cutting/improve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;

const Plane away({100, 0, 0}, {1, 0, 0});

int alive(const BandMesh& band) {
    int count = 0;
    for (int t = 0; t < band.tetras.size(); ++t) count += band.tetras.alive(t);
    return count;
}

double worst_of(const Workpiece& f) {
    double worst = 1;
    for (int t = 0; t < f.d.band.tetras.size(); ++t)
        if (f.d.band.tetras.alive(t)) worst = std::min(worst, tetra_quality(f.d, t));
    return worst;
}

TEST(Improve, MergesANodeBornTooCloseToAnother) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, away);
    const double before = worst_of(f);
    const int born = f.split_edge(node_at(f.d.band, {1, 1, 1}), node_at(f.d.band, {2, 1, 1}), Vec3(1.02, 1, 1), {});
    ASSERT_LT(worst_of(f), 0.2);
    improve(f, 0.45);
    EXPECT_FALSE(f.d.band.in_use(born));
    EXPECT_EQ(alive(f.d.band), 48);
    EXPECT_EQ(worst_of(f), before);
    for (int v = 0; v < 27; ++v) EXPECT_EQ(f.d.band.nodes[v].at, f.d.band.nodes[v].start);
}

TEST(Improve, KeepsANodeOfACrossingOfTools) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Plane in_x({1.02, 0, 0}, {1, 0, 0}), in_y({0, 1, 0}, {0, 1, 0});
    Workpiece f = checks::whole_workpiece(mesh, away);
    const int born = f.split_edge(node_at(f.d.band, {1, 1, 1}), node_at(f.d.band, {2, 1, 1}), Vec3(1.02, 1, 1),
                                  Contact(&in_x).with(&in_y));
    improve(f, 0.45);
    EXPECT_TRUE(f.d.band.in_use(born));
    EXPECT_NEAR(f.d.band.nodes[born].at.x(), 1.02, 1e-9) << "it may move along the line where they cross";
    EXPECT_NEAR(f.d.band.nodes[born].at.y(), 1, 1e-9);
}

TEST(Improve, LeavesGoodElementsAlone) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, away);
    improve(f, 0.45);
    EXPECT_EQ(f.d.band.size(), 27);
    EXPECT_EQ(f.d.band.tetras.size(), 48);
}

TEST(Improve, BisectsLongEdgesOfElementsNothingElseHelps) {
    // One edge is eight times as long as the two that it crosses are wide; all nodes are corners of the skin.
    Mesh mesh;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(8, 0, 0), Vec3(4, 1, 0), Vec3(4, 0, 1)})
        mesh.add_node(at, mesh.node_count() + 1);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 1);
    Workpiece f = checks::whole_workpiece(mesh, away);
    ASSERT_LT(worst_of(f), 0.35);
    improve(f, 0.45);
    EXPECT_GT(alive(f.d.band), 1);
    EXPECT_EQ(f.d.band.nodes[4].start, Vec3(4, 0, 0));
    EXPECT_TRUE(f.d.band.in_use(4));
    // Not when the band has as many elements as it may.
    Workpiece full = checks::whole_workpiece(mesh, away);
    full.most_elements = 1;
    improve(full, 0.45);
    EXPECT_EQ(alive(full.d.band), 1);
}

TEST(RelaxBand, BringsTheNodesAroundAnInterfaceIntoShape) {
    const Mesh mesh = checks::grid(4, 4, 4);
    const Plane plane({2, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    const int astray = node_at(f.d.band, {1, 2, 2});
    f.d.band.nodes[astray].at.x() = 1.9;
    const double before = worst_of(f);
    ASSERT_LT(before, 0.3);
    relax_band(f);
    EXPECT_EQ(f.nodes.size(), 25u);
    EXPECT_EQ(f.transition.size(), 100u);
    EXPECT_GT(worst_of(f), 0.5);
    for (const int v : f.nodes) EXPECT_NEAR(f.d.band.nodes[v].at.x(), 2, 1e-9);
    EXPECT_LT(f.d.band.nodes[astray].at.x(), 1.8);
    EXPECT_EQ(alive(f.d.band), 384);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
