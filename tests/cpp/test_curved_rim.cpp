// SPDX-License-Identifier: LGPL-2.1-or-later
// Curves of an addition along a seam (as merge() uses it, see tests/python/test_merge_curved.py).
#include "operators/curved_rim.h"

#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// A floor of two second-order triangles with a common edge along x, whose other corners are `width` off it, and a wall
/// that stands on that edge and is bent in y.
struct FloorAndWall {
    Mesh floor, own, wall;
    Index of_floor, of_wall;  ///< the mid-side nodes of the common edge
    CommonEdge edge;

    explicit FloorAndWall(double bulge, double width = 1, double rise = 0) {
        Mesh flat, standing;
        for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, width, 0), Vec3(0.5, -width, rise)})
            flat.add_node(x, flat.node_count() + 1);
        flat.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 1);
        flat.add_cell(CellType::triangle, std::array<Index, 3>{1, 0, 3}, 2);
        floor = checks::second_order(flat);
        checks::add_plate(standing, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 1, 1);
        own = checks::second_order(standing);
        of_floor = checks::number_near(floor, {0.5, 0, 0});
        of_wall = checks::number_near(own, {0.5, 0, 0});
        edge.ends = {{{0, 1}, {checks::number_near(own, {0, 0, 0}), checks::number_near(own, {1, 0, 0})}}};
        wall = own;  // made to lie along the floor's edge
        for (const double z : {0.0, 0.5, 1.0}) own.points[checks::number_near(own, {0.5, 0, z})][1] = bulge;
    }

    BentRim bend() { return bend_rim(own, floor, wall, {&edge, 1}); }
};

TEST(CurvedRim, BendsTheEdgesOfBoth) {
    FloorAndWall f(0.1);
    const BentRim rim = f.bend();
    EXPECT_EQ(rim.bent, 1);
    EXPECT_EQ(rim.straight, 0);
    EXPECT_LT((f.floor.points[f.of_floor] - Vec3(0.5, 0.1, 0)).norm(), 1e-9);
    EXPECT_EQ(f.floor.points[f.of_floor], f.wall.points[f.of_wall]);
}

TEST(CurvedRim, LeavesWhatIsStraightAlone) {
    FloorAndWall f(0);
    const Mesh before = f.floor;
    const BentRim rim = f.bend();
    EXPECT_EQ(rim.bent + rim.straight, 0);
    EXPECT_EQ(f.floor.points, before.points);
}

TEST(CurvedRim, TellsWhereItCannotBend) {
    FloorAndWall narrow(0.1, 0.12), creased(0.1, 1, 0.2), held(0.1);
    held.edge.bound = true;
    for (FloorAndWall* f : {&narrow, &creased, &held}) {
        const Mesh before = f->floor;
        const BentRim rim = f->bend();
        EXPECT_EQ(rim.bent, 0);
        EXPECT_EQ(rim.straight, 1);
        EXPECT_NEAR(rim.largest, 0.1, 1e-9);
        EXPECT_EQ(f->floor.points, before.points);
        EXPECT_EQ(f->wall.points[f->of_wall], Vec3(0.5, 0, 0));
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
