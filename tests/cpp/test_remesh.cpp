// SPDX-License-Identifier: LGPL-2.1-or-later
// Which edges are divided, which nodes are merged away, and which are not.
#include "cutting/remesh.h"

#include <gtest/gtest.h>

#include <functional>

#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

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
    EXPECT_GT(r.worst().mean_ratio, 0.3);
}

/// Whether the middle node of a cube of eight, near a side, is taken out; `member`: which are in a group of nodes.
bool middle_goes(const std::function<bool(const Vec3&)>& member) {
    Mesh mesh = checks::grid(2, 2, 2);
    const FamilyIndex family = checks::family_of(mesh, "G", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (member(mesh.points[n])) mesh.node_families[n] = family;
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    Remesher r = remesher(f, mesh);
    EXPECT_EQ(node_at(f.d.band, {1, 1, 1}), 13);
    f.d.band.nodes[13].at.x() = 1.95;
    r.run(0.3);
    EXPECT_GT(r.taken_out(), 0);
    return !f.d.band.in_use(13);
}

TEST(Remesh, MergesWhereEdgesAreShort) {
    EXPECT_TRUE(middle_goes([](const Vec3&) { return false; }));
    EXPECT_TRUE(middle_goes([](const Vec3&) { return true; })) << "a group of all nodes means none of them alone";
    EXPECT_FALSE(middle_goes([](const Vec3& x) { return x == Vec3(1, 1, 1); }));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
