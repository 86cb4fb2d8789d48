// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/slide_off.h"

#include <gtest/gtest.h>

#include "wall_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::WithWall;

std::optional<Vec3> pushed(const WithWall& w, const Vec3& by) {
    return slides_off(
        w.f.d.band, [&](int v) -> Vec3 { return w.f.d.band.nodes[v].at + by; }, 0.3);
}

/// A block with a step: the wall is its upper face, or its side above the step.
Mesh step() {
    Mesh all = checks::grid(4, 2, 4), out;
    const CellBlock& b = all.block(CellType::tetra);
    std::vector<Index> place(all.points.size(), -1);
    for (Index c = 0; c < b.size(); ++c) {
        Vec3 middle = Vec3::Zero();
        for (const Index n : b.nodes(c)) middle += all.points[n] / 4;
        if (middle.x() > 2 && middle.z() > 2) continue;
        std::vector<Index> nodes;
        for (const Index n : b.nodes(c)) {
            if (place[n] < 0) place[n] = out.add_node(all.points[n], out.node_count() + 1);
            nodes.push_back(place[n]);
        }
        out.add_cell(CellType::tetra, nodes, out.cell_count() + 1);
    }
    return out;
}

TEST(SlideOff, AFacePastAStep) {
    const WithWall top(step(), [](const Vec3& x) { return x.z() == 4; });
    EXPECT_FALSE(pushed(top, {0, 0, 3})) << "outwards";
    EXPECT_FALSE(pushed(top, {0, 0, -1.9}));
    const auto at = pushed(top, {0, 0, -2.5});
    ASSERT_TRUE(at);
    EXPECT_EQ(at->x(), 2) << "where the side above the step ends";
    const WithWall side(step(), [](const Vec3& x) { return x.x() == 2 && x.z() >= 2; });
    EXPECT_FALSE(pushed(side, {1.9, 0, 0}));
    EXPECT_TRUE(pushed(side, {2.5, 0, 0})) << "past the end of the step";
    EXPECT_FALSE(pushed(side, {-1.9, 0, 0}));
}

TEST(SlideOff, ABorderPastTheEndOfALine) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, Vec3::UnitX(), Vec3::UnitY(), 2, 4);
    checks::add_plate(mesh, {2, 0, 0}, Vec3::UnitX(), Vec3::UnitY(), 2, 2);
    const WithWall side(mesh, [](const Vec3& x) { return x.x() == 2 && x.y() >= 2; });
    EXPECT_FALSE(pushed(side, {1.9, 0, 0}));
    EXPECT_TRUE(pushed(side, {2.5, 0, 0}));
    EXPECT_FALSE(pushed(side, {-1.9, 0, 0}));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
