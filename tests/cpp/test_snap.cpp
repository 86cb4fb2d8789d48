// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes moved onto a tool, and edges bisected on it, in small blocks of cubes.
#include "cutting/snap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/quality.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "tools/sphere.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;

double volume(const BandMesh& band) {
    double sum = 0;
    for (int t = 0; t < band.tetras.size(); ++t)
        if (band.tetras.alive(t)) {
            const auto& n = band.tetras[t];
            sum += signed_volume(band.nodes[n[0]].at, band.nodes[n[1]].at, band.nodes[n[2]].at, band.nodes[n[3]].at);
        }
    return sum;
}

/// Elements that reach to both sides of a tool.
int crossed(const Workpiece& f, const Tool& tool) {
    int count = 0;
    for (int t = 0; t < f.d.band.tetras.size(); ++t) {
        const auto& n = f.d.band.tetras[t];
        const auto beyond = [&](double sign) {
            return std::ranges::any_of(n, [&](int v) { return sign * tool.distance(f.d.band.nodes[v].at) > 1e-9; });
        };
        count += f.d.band.tetras.alive(t) && beyond(1) && beyond(-1);
    }
    return count;
}

TEST(CutAlong, MovesNearNodesOntoTheTool) {
    const Mesh mesh = checks::grid(4, 1, 1);
    const Plane plane({1.9, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    cut_along(f, {.tool = &plane, .bound = {}, .inside = {}, .tag = 5});
    const BandMesh& band = f.d.band;
    EXPECT_EQ(band.size(), 20) << "none is born";
    for (int v = 0; v < band.size(); ++v) {
        const bool moved = band.nodes[v].start.x() == 2;
        EXPECT_EQ(f.d.contact[v].has(&plane), moved);
        EXPECT_NEAR(band.nodes[v].at.x(), moved ? 1.9 : band.nodes[v].start.x(), 1e-14);
        EXPECT_EQ(band.nodes[v].at.tail<2>(), band.nodes[v].start.tail<2>());
        EXPECT_EQ(f.distance[v] == 0, moved);
    }
    ASSERT_EQ(band.cut_faces.size(), 2);
    for (int s = 0; s < 2; ++s) {
        EXPECT_EQ(band.cut_faces.tag(s), 5);
        for (const int v : band.cut_faces[s]) EXPECT_TRUE(f.d.contact[v].has(&plane));
    }
    EXPECT_EQ(crossed(f, plane), 0);
}

TEST(CutAlong, BisectsEdgesWhoseEndsAreNotToMove) {
    const Mesh mesh = checks::grid(4, 1, 1);
    const Plane plane({1.5, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    std::ranges::fill(f.d.off_tool, 1);
    cut_along(f, {.tool = &plane, .bound = {}, .inside = {}});
    const BandMesh& band = f.d.band;
    // Of a cube's edges and diagonals those along x: four edges, four diagonals of faces, one of the whole.
    EXPECT_EQ(band.size(), 20 + 9);
    for (int v = 0; v < band.size(); ++v) {
        EXPECT_EQ(f.d.contact[v].has(&plane), band.is_new(v));
        if (band.is_new(v)) {
            EXPECT_NEAR(band.nodes[v].at.x(), 1.5, 1e-14);
        }
        if (!band.is_new(v)) {
            EXPECT_EQ(band.nodes[v].at, band.nodes[v].start);
        }
    }
    EXPECT_EQ(crossed(f, plane), 0);
    EXPECT_NEAR(volume(band), 4, 1e-14);
    EXPECT_EQ(band.cut_faces.size(), 0) << "without a tag none are collected";
}

TEST(CutAlong, IsWantedOnlyInsideOtherTools) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Plane in_x({1, 0, 0}, {1, 0, 0}), in_y({0, 1, 0}, {0, 1, 0});
    Workpiece f = checks::whole_workpiece(mesh, in_y);
    cut_along(f, {.tool = &in_x, .bound = {}, .inside = {&in_y}, .tag = 2});
    const BandMesh& band = f.d.band;
    for (int v = 0; v < band.size(); ++v) {
        const Vec3& at = band.nodes[v].at;
        EXPECT_EQ(f.d.contact[v].has(&in_x), at.x() == 1 && at.y() <= 1);
        EXPECT_EQ(f.d.contact[v].has(&in_y), at.y() == 1) << "contacts from before stay";
    }
    EXPECT_EQ(band.cut_faces.size(), 4);
    for (int s = 0; s < band.cut_faces.size(); ++s)
        for (const int v : band.cut_faces[s]) EXPECT_LE(band.nodes[v].at.y(), 1);
}

TEST(CutAlong, CollectsEdgesOfShells) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 3);
    const Plane plane({1, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    cut_along(f, {.tool = &plane, .bound = {}, .inside = {}, .tag = 1});
    ASSERT_EQ(f.d.band.cut_edges.size(), 3);
    for (int s = 0; s < 3; ++s) {
        EXPECT_EQ(f.d.band.cut_edges.tag(s), 1);
        for (const int v : f.d.band.cut_edges[s]) EXPECT_EQ(f.d.band.nodes[v].at.x(), 1);
    }
}

TEST(CutAlong, HalvesEdgesThatDipThroughACurvedTool) {
    // Both ends of the edges along x at y = z = 0 are outside a sphere about the middle of one of them.
    const Mesh mesh = checks::grid(2, 1, 1);
    const Sphere sphere({0.5, 0, 0}, 0.4);
    Workpiece f = checks::whole_workpiece(mesh, sphere);
    cut_along(f, {.tool = &sphere, .bound = {}, .inside = {}});
    const int born = node_at(f.d.band, {0.5, 0, 0});
    EXPECT_TRUE(f.d.band.is_new(born));
    EXPECT_NEAR(f.distance[born], -0.4, 1e-14);
    for (int v = 0; v < f.d.band.size(); ++v)
        if (f.d.contact[v]) {
            EXPECT_NEAR((f.d.band.nodes[v].at - Vec3(0.5, 0, 0)).norm(), 0.4, 1e-9);
        }
}

TEST(PutOnTool, MovesANodeWithinRounding) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Plane away({9, 0, 0}, {1, 0, 0}), near({1 + 1e-7, 0, 0}, {1, 0, 0}), corner({1e-7, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, away);
    const int inside = node_at(f.d.band, {1, 1, 1}), held = node_at(f.d.band, {0, 0, 0});
    put_on_tool(f, inside, near);
    EXPECT_EQ(f.d.band.nodes[inside].at, Vec3(1 + 1e-7, 1, 1));
    EXPECT_EQ(f.d.constraints[inside].freedom, NodeFreedom::free);
    EXPECT_TRUE(f.d.contact[inside].has(&near));
    // A corner of the skin leaves its place for the tool's, and is held there.
    put_on_tool(f, held, corner);
    EXPECT_EQ(f.d.band.nodes[held].at, Vec3(1e-7, 0, 0));
    EXPECT_EQ(f.d.constraints[held].freedom, NodeFreedom::fixed);
    EXPECT_TRUE(f.d.contact[held].has(&corner));
    EXPECT_EQ(f.d.held_off[held], 0);
}

TEST(PutOnTool, DoesNotSlideANodeFarAlongASurface) {
    // At two degrees between the top and the tool the node would slide 29 times as far as it is off.
    const Mesh mesh = checks::grid(2, 2, 2);
    const Vec3 normal = Vec3(std::sin(0.035), 0, std::cos(0.035)), top(1, 1, 2), there = top - 1e-3 * normal;
    const Plane away({9, 0, 0}, {1, 0, 0}), slanting(there, normal);
    Workpiece f = checks::whole_workpiece(mesh, away);
    const int node = node_at(f.d.band, top);
    put_on_tool(f, node, slanting);
    EXPECT_LT((f.d.band.nodes[node].at - there).norm(), 1e-12);
    EXPECT_EQ(f.d.constraints[node].freedom, NodeFreedom::fixed);
}

TEST(PutOnTool, HoldsANodeBesideWhereItCannotMove) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const Plane away({9, 0, 0}, {1, 0, 0}), far({1.999, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, away);
    const int inside = node_at(f.d.band, {1, 1, 1});
    put_on_tool(f, inside, far);  // there its elements would be flat
    EXPECT_EQ(f.d.band.nodes[inside].at, Vec3(1, 1, 1));
    EXPECT_TRUE(f.d.contact[inside].has(&far));
    EXPECT_NEAR(f.d.held_off[inside], 0.999, 1e-14);
    EXPECT_NEAR(f.d.off_tools(inside), 0, 1e-14);
}

TEST(IsBeside, ComparesWithTheReachBeyondTheTool) {
    EXPECT_TRUE(is_beside(0.02, 2, 0.01));
    EXPECT_TRUE(is_beside(-0.02, 2, 0.01));
    EXPECT_FALSE(is_beside(-0.03, 2, 0.01));
    EXPECT_FALSE(is_beside(0.02, 1, 0.01));
}

TEST(SnapToTool, CutsAndRelaxes) {
    const Mesh mesh = checks::grid(4, 2, 2);
    const Plane plane({1.7, 0, 0}, {1, 0.1, 0});
    Workpiece f = checks::whole_workpiece(mesh, plane);
    snap_to_tool(f, {.tool = &plane, .bound = {}, .inside = {}}, mesh.cell_count());
    EXPECT_EQ(crossed(f, plane), 0);
    EXPECT_NEAR(volume(f.d.band), 16, 1e-12);
    EXPECT_GE(f.nodes.size(), 9u);
    for (const int v : f.nodes) EXPECT_LT(std::abs(plane.distance(f.d.band.nodes[v].at)), 1e-9);
    for (int t = 0; t < f.d.band.tetras.size(); ++t)
        if (f.d.band.tetras.alive(t)) {
            EXPECT_GT(tetra_quality(f.d, t), 0.3);
        }
    // No node may change sides from here on.
    EXPECT_EQ(f.d.barrier, &plane);
    EXPECT_EQ(f.d.side[node_at(f.d.band, {0, 0, 0})], -1);
    EXPECT_EQ(f.d.side[node_at(f.d.band, {4, 0, 0})], 1);
    EXPECT_EQ(f.d.side[f.nodes[0]], 0);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
