// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/deformation.h"

#include <gtest/gtest.h>

#include "cutting/workpiece.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;

double worst_of(const Deformable& d) {
    double worst = 1;
    for (int t = 0; t < d.band.tetras.size(); ++t) worst = std::min(worst, tetra_quality(d, t));
    return worst;
}

TEST(Deformation, CarriesTheNodesAroundAnInterfaceAlong) {
    // The middle nodes of a bar were put on a plane 0.8 farther on.
    const Mesh mesh = checks::grid(6, 3, 3);
    const Plane there({3.8, 0, 0}, {1, 0, 0}), here({3, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, here);
    find_node_sets(f);
    for (const int v : f.nodes) {
        f.d.band.nodes[v].at.x() = 3.8;
        f.d.contact[v] = &there;
    }
    const double before = worst_of(f.d);
    ASSERT_LT(before, 0.5);
    deform(f.d, f.nodes, f.transition);
    EXPECT_GT(worst_of(f.d), 0.55);
    for (const int v : f.nodes) EXPECT_NEAR(f.d.band.nodes[v].at.x(), 3.8, 1e-12);
    EXPECT_GT(f.d.band.nodes[node_at(f.d.band, {6, 0, 0})].at.x(), 5.9) << "the ends stay";
    for (int v = 0; v < f.d.band.size(); ++v)
        if (f.d.band.nodes[v].start.x() == 4) {
            EXPECT_GT(f.d.band.nodes[v].at.x(), 4.1);
        }
}

TEST(Deformation, TurnsElementsBackThatRelaxingCouldNot) {
    // A node of the interface has gone past the next: only the bar network brings that over.
    const Mesh mesh = checks::grid(8, 4, 4);
    const Plane away({100, 0, 0}, {1, 0, 0}), there({5.05, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, away);
    const int gone = node_at(f.d.band, {4, 2, 2}), next = node_at(f.d.band, {5, 2, 2});
    f.d.band.nodes[gone].at.x() = 5.05;
    f.d.contact[gone] = &there;
    find_node_sets(f);
    ASSERT_LE(quality_around(f.d, gone, f.d.band.nodes[gone].at), 0);
    deform(f.d, f.nodes, f.transition);
    EXPECT_GT(worst_of(f.d), 0.1);
    EXPECT_GT(f.d.band.nodes[next].at.x(), 5.05);
}

TEST(Deformation, MovesNothingWhereAllIsWell) {
    const Mesh mesh = checks::grid(4, 2, 2);
    const Plane here({2, 0, 0}, {1, 0, 0});
    Workpiece f = checks::whole_workpiece(mesh, here);
    find_node_sets(f);
    deform(f.d, f.nodes, f.transition);
    for (const BandNode& n : f.d.band.nodes) EXPECT_EQ(n.at, n.start);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
