// SPDX-License-Identifier: LGPL-2.1-or-later
// Where the nodes of a wall end.
#include "cutting/wall_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/plane.h"
#include "wall_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using checks::WithWall;

WithWall block() {
    return WithWall(checks::grid(3, 3, 3), [](const Vec3& x) { return x.z() == 3; });
}

TEST(WallMotion, APlaneCarriedIsAPlane) {
    const WithWall w = block();
    WallMotion motion{.parameter = "by", .carried = {1, {0.3, 0.2, 0.5}}};
    find_tools(w.f, w.wall, motion);
    ASSERT_EQ(motion.tools.size(), 1U);
    EXPECT_EQ(motion.tools[0]->kind(), "plane");
    const WallGoals goals(w.f, w.wall, motion, w.mesh);
    EXPECT_NEAR(goals[node_at(w.f.d.band, {1, 1, 3})].z(), 3.5, 1e-12);
    const Vec3 corner = goals[node_at(w.f.d.band, {3, 3, 3})];
    EXPECT_NEAR((corner - Vec3(3, 3, 3.5)).norm(), 0, 1e-12) << "corners stay on their edges";
    EXPECT_NEAR(goals[node_at(w.f.d.band, {3, 1, 3})].x(), 3, 1e-12) << "the rim on its faces";
}

TEST(WallMotion, OntoAToolThatLeans) {
    const WithWall w = block();
    const Plane plane({0, 0, 3}, {0.3, 0, 1});
    WallMotion motion{.parameter = "onto", .onto = &plane};
    find_tools(w.f, w.wall, motion);
    const WallGoals goals(w.f, w.wall, motion, w.mesh);
    for (const int v : w.wall.nodes) EXPECT_NEAR(plane.distance(goals[v]), 0, 1e-12);
    EXPECT_NEAR((goals[node_at(w.f.d.band, {3, 0, 3})] - Vec3(3, 0, 2.1)).norm(), 0, 1e-12);
    // Those inside go aside as the rim has to.
    EXPECT_GT(goals[node_at(w.f.d.band, {2, 1, 3})].x(), 1.75);
    EXPECT_EQ(goals.tools(w.wall.nodes[0]).count(), 1);
}

TEST(WallMotion, WhatCannotBeReachedNamesTheParameter) {
    const WithWall w = block();
    const Plane plane({0.5, 0, 0}, {1, 0, 0});
    WallMotion motion{.parameter = "onto", .onto = &plane};
    find_tools(w.f, w.wall, motion);
    try {
        const WallGoals goals(w.f, w.wall, motion, w.mesh);
        FAIL();
    } catch (const ToolError& e) {
        EXPECT_STREQ(e.parameter(), "onto");
        EXPECT_THAT(e.what(), testing::HasSubstr("cannot get there"));
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
