// SPDX-License-Identifier: LGPL-2.1-or-later
// Which edges are divided, which nodes are merged away, and which are not.
#include "cutting/remesh.h"

#include <gtest/gtest.h>

#include "whole_workpiece.h"

namespace femscalpel {
namespace {

using checks::node_at;

Remesher remesher(Workpiece& f, const Mesh& mesh) {
    return Remesher(f, mesh, [](int) { return false; });
}

/// Makes the band longer or shorter in x.
void stretch(Workpiece& f, double by) {
    for (BandNode& n : f.d.band.nodes) n.at.x() *= by;
}

TEST(Remesh, LeavesAlone) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    Remesher r = remesher(f, mesh);
    r.run(0.3);
    EXPECT_EQ(f.d.band.size(), 27);
    EXPECT_EQ(r.taken_out(), 0);
    EXPECT_TRUE(r.strained().empty());
}

TEST(Remesh, DividesLongEdges) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    Remesher r = remesher(f, mesh);
    stretch(f, 2.5);
    r.run(0.3);
    EXPECT_GT(f.d.band.size(), 27);
    EXPECT_GT(r.worst(), 0.3);
}

/// A long block pressed together, with a group of nodes.
int taken_out(const std::function<bool(const Vec3&)>& member) {
    Mesh mesh = checks::grid(6, 2, 2);
    const FamilyIndex family = checks::family_of(mesh, "G", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (member(mesh.points[n])) mesh.node_families[n] = family;
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    Remesher r = remesher(f, mesh);
    stretch(f, 0.2);
    r.run(0.3);
    return r.taken_out();
}

TEST(Remesh, MergesWhereEdgesAreShort) {
    const int without = taken_out([](const Vec3&) { return false; });
    EXPECT_GT(without, 3);
    EXPECT_EQ(taken_out([](const Vec3&) { return true; }), without) << "a group of all nodes means none of them alone";
    EXPECT_LT(taken_out([](const Vec3& x) { return std::fmod(x.x(), 2) == 1; }), without);
}

}  // namespace
}  // namespace femscalpel
