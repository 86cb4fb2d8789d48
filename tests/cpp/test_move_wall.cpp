// SPDX-License-Identifier: LGPL-2.1-or-later
// Walls on their way, step by step.
#include "cutting/move_wall.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "wall_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::WithWall;

MovedWall push(WithWall& w, const Vec3& by) {
    WallMotion motion{.parameter = "by", .carried = {1, by}};
    find_tools(w.f, w.wall, motion);
    MovedWall out = move_wall(w.f, w.wall, motion, w.mesh);
    for (int v = 0; v < w.f.d.band.size(); ++v) w.f.d.contact[v] = {};  // as the tools end here
    return out;
}

WithWall block() {
    return WithWall(checks::grid(4, 4, 4), [](const Vec3& x) { return x.z() == 4; });
}

double worst(WithWall& w) {
    double out = 1;
    for (int t = 0; t < w.f.d.band.tetras.size(); ++t)
        if (w.f.d.band.tetras.alive(t)) out = std::min(out, tetra_quality(w.f.d, t));
    return out;
}

TEST(MoveWall, VolumeFollowsExactly) {
    for (const double by : {-2.5, -1.0, 0.1, 1.0, 3.0}) {
        WithWall w = block();
        const MovedWall moved = push(w, {0, 0, by});
        EXPECT_GE(moved.steps, std::abs(by) > 0.5 ? 2 : 1) << by;
        EXPECT_NEAR(checks::volume(w.f), 16 * (4 + by), 1e-9) << by;
        EXPECT_GT(worst(w), 0.3) << by;
    }
}

TEST(MoveWall, NodesAreTakenOutWhereThereIsNoRoom) {
    WithWall w = block();
    EXPECT_GT(push(w, {0, 0, -3.7}).taken_out, 0);
    EXPECT_NEAR(checks::volume(w.f), 16 * 0.3, 1e-9);
}

TEST(MoveWall, EdgesAreDividedWhereTheyGetLong) {
    WithWall w = block();
    push(w, {0, 0, 12});
    EXPECT_GT(w.f.d.band.size(), w.f.d.band.original_nodes());
    EXPECT_NEAR(checks::volume(w.f), 16 * 16, 1e-9);
}

std::string refusal(WithWall& w, const Vec3& by) {
    try {
        push(w, by);
    } catch (const ToolError& e) {
        EXPECT_STREQ(e.parameter(), "by");
        EXPECT_EQ(w.f.d.band.size(), w.f.d.band.original_nodes());
        return e.what();
    }
    ADD_FAILURE() << "no error";
    return "";
}

TEST(MoveWall, NotThroughTheOtherSide) {
    using testing::HasSubstr;
    for (const double by : {-4.5, -6.0, -40.0}) {
        WithWall w = block();
        EXPECT_THAT(refusal(w, {0, 0, by}), HasSubstr("pass through the part")) << by;
        for (const BandNode& n : w.f.d.band.nodes) EXPECT_EQ(n.at, n.start);
    }
    WithWall w = block();  // too little for that to tell
    EXPECT_THROW(push(w, {0, 0, -4.2}), ToolError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
