// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/border_overlap.h"

#include <gtest/gtest.h>

#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// Two plates of two triangles side by side, apart by `gap`.
Mesh two_plates(double gap) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, Vec3::UnitX(), Vec3::UnitY(), 2, 2);
    const Index first = mesh.node_count();
    checks::add_plate(mesh, {10, 0, 0}, Vec3::UnitX(), Vec3::UnitY(), 2, 2);
    for (Index n = first; n < mesh.node_count(); ++n) mesh.points[n].x() += gap - 8;
    return mesh;
}

/// After nodes at x = 2 + gap went to x = 2, and by `up`.
std::optional<Vec3> closed(double gap, double up) {
    const Mesh mesh = two_plates(gap);
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    for (BandNode& n : f.d.band.nodes)
        if (std::abs(n.at.x() - 2 - gap) < 1e-9) n.at = {2, n.at.y() + up, 0};
    return border_overlap(f.d);
}

TEST(BorderOverlap, SidesThatCameOntoEachOther) {
    EXPECT_TRUE(closed(0.5, 0.25)) << "nodes on edges";
    EXPECT_TRUE(closed(0.5, 0)) << "nodes on nodes";
    EXPECT_FALSE(closed(0.5, 7)) << "beside";
}

TEST(BorderOverlap, LipsOfACrack) {
    EXPECT_FALSE(border_overlap(checks::whole_workpiece(two_plates(0.5), checks::away).d));
    EXPECT_TRUE(border_overlap(checks::whole_workpiece(two_plates(0), checks::away).d));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
