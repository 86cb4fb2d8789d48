// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/untangler.h"

#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

double worst_of(const Deformable& d) {
    double worst = 1;
    for (int t = 0; t < d.band.tetras.size(); ++t) worst = std::min(worst, tetra_quality(d, t));
    for (int t = 0; t < d.band.triangles.size(); ++t)
        if (d.constraints.is_shell(d.band.triangles.origin(t))) worst = std::min(worst, shell_quality(d, t));
    return worst;
}

/// A plane that is nowhere near.
const Plane away({100, 0, 0}, {1, 0, 0});

/// All band nodes' places but one's.
std::vector<Vec3> places(const BandMesh& band, int but) {
    std::vector<Vec3> out;
    for (int v = 0; v < band.size(); ++v)
        if (v != but) out.push_back(band.nodes[v].at);
    return out;
}

TEST(Untangler, BringsANodeBackIntoItsStar) {
    const Mesh mesh = checks::grid(2, 2, 2);
    for (const Vec3& out : {Vec3(2.3, 1.1, 0.9), Vec3(1, -0.2, 1), Vec3(0.3, 2.4, 1.9)}) {
        Deformable d = checks::whole_workpiece(mesh, away).d;
        const int centre = checks::node_at(d.band, {1, 1, 1});
        const std::vector<Vec3> others = places(d.band, centre);
        d.band.nodes[centre].at = out;
        ASSERT_LT(worst_of(d), 0);
        const double reached = untangle(d, {centre}, 0.2);
        EXPECT_GE(reached, 0.2);
        EXPECT_EQ(reached, worst_of(d));
        EXPECT_EQ(places(d.band, centre), others);
    }
}

TEST(Untangler, MovesNodesAlongTheSkinOnly) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Deformable d = checks::whole_workpiece(mesh, away).d;
    const int face = checks::node_at(d.band, {2, 1, 1}), edge = checks::node_at(d.band, {2, 1, 2});
    d.band.nodes[face].at = {2, 2.2, 1.1};
    d.band.nodes[edge].at = {2, -0.3, 2};
    ASSERT_LT(worst_of(d), 0);
    EXPECT_GE(untangle(d, {face, edge}, 0.2), 0.2);
    EXPECT_NEAR(d.band.nodes[face].at.x(), 2, 1e-12);
    EXPECT_NEAR(d.band.nodes[edge].at.x(), 2, 1e-12);
    EXPECT_NEAR(d.band.nodes[edge].at.z(), 2, 1e-12);
}

TEST(Untangler, TurnsShellsBack) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 3);
    Deformable d = checks::whole_workpiece(mesh, away).d;
    const int node = checks::node_at(d.band, {1, 1, 0});
    d.band.nodes[node].at = {2.5, 2.2, 0};
    ASSERT_LT(worst_of(d), 0);
    EXPECT_GE(untangle(d, {node}, 0.2), 0.2);
    EXPECT_NEAR(d.band.nodes[node].at.z(), 0, 1e-12);
}

TEST(Untangler, LeavesGoodElementsAlone) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Deformable d = checks::whole_workpiece(mesh, away).d;
    const int centre = checks::node_at(d.band, {1, 1, 1});
    d.band.nodes[centre].at = {1.2, 0.9, 1.1};
    const double before = worst_of(d);
    ASSERT_GT(before, 0.2);
    EXPECT_EQ(untangle(d, {centre}, 0.2), before);
    EXPECT_EQ(d.band.nodes[centre].at, Vec3(1.2, 0.9, 1.1));
}

TEST(Untangler, SaysWhenItIsNoUse) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Deformable d = checks::whole_workpiece(mesh, away).d;
    const int centre = checks::node_at(d.band, {1, 1, 1});
    d.band.nodes[centre].at = {2.3, 1, 1};
    // The node that is astray is not among those that may move.
    EXPECT_LT(untangle(d, {checks::node_at(d.band, {0, 0, 0})}, 0.2), 0);
    EXPECT_EQ(d.band.nodes[centre].at, Vec3(2.3, 1, 1));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
