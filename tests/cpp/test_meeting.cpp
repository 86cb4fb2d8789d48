// SPDX-License-Identifier: LGPL-2.1-or-later
// Where two meshes meet, as lines.
#include "cutting/meeting.h"

#include <gtest/gtest.h>

#include "cutting/meeting_lines.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

double length(const MeetingLine& line) {
    double sum = 0;
    for (std::size_t k = 1; k < line.points.size(); ++k) sum += (line.points[k].at - line.points[k - 1].at).norm();
    return line.closed ? sum + (line.points.front().at - line.points.back().at).norm() : sum;
}

Mesh plate(const Vec3& origin, const Vec3& x, const Vec3& y, int nx, int ny) {
    Mesh mesh;
    checks::add_plate(mesh, origin, x, y, nx, ny);
    return mesh;
}

const Mesh ground = plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 6, 5);

const MeetingLines::Sides up{{Vec3::UnitZ(), Vec3::UnitY()}, {1, 1}};

TEST(MeetingLines, JoinSegmentsToSmoothPieces) {
    MeetingLines lines(1e-6);
    // Any order and direction: an L of two and one.
    lines.add({Vec3(1, 0, 0), Vec3(0, 0, 0)}, up);
    lines.add({Vec3(2, 3, 0), Vec3(2, 0, 0)}, up);
    lines.add({Vec3(1, 0, 0), Vec3(2, 0, 0)}, up);
    const auto pieces = lines.pieces();
    ASSERT_EQ(pieces.size(), 2u);
    EXPECT_NEAR(length(pieces[0]) + length(pieces[1]), 5, 1e-12);
    EXPECT_NEAR(std::max(length(pieces[0]), length(pieces[1])), 3, 1e-12);
}

TEST(MeetingLines, ASmoothRingIsOneClosedPiece) {
    MeetingLines lines(1e-6);
    const auto at = [](int k) { return Vec3(std::cos(k * M_PI / 12), std::sin(k * M_PI / 12), 0); };
    for (int k = 0; k < 24; ++k) lines.add({at(k), at(k + 1)}, {{Vec3::UnitZ(), at(k)}, {1, 1}});
    const auto pieces = lines.pieces();
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_TRUE(pieces[0].closed);
    EXPECT_EQ(pieces[0].points.size(), 24u);
}

TEST(MeetingLines, GoThroughPointsThatAreNear) {
    MeetingLines lines(1e-6);
    lines.add_node({1, 0.01, 0}, 0, 7);
    lines.add({Vec3(0, 0, 0), Vec3(2, 0, 0)}, up, 0.02);
    const auto pieces = lines.pieces();
    ASSERT_EQ(pieces.size(), 1u);
    ASSERT_EQ(pieces[0].points.size(), 3u);
    EXPECT_EQ(pieces[0].points[1].node[0], 7);
}

TEST(MeetingLines, LooseEndsThatAreShortGo) {
    MeetingLines lines(1e-6);
    lines.add({Vec3(0, 0, 0), Vec3(1, 0, 0)}, up);
    lines.add({Vec3(1, 0, 0), Vec3(2, 0, 0)}, up);
    lines.add({Vec3(1, 0, 0), Vec3(1, 0.1, 0)}, up);
    lines.prune(0.2);
    const auto pieces = lines.pieces();
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_NEAR(length(pieces[0]), 2, 1e-12);
}

TEST(FindMeeting, OfAPlateThatStandsOnAnother) {
    const Mesh rib = plate({1.2, 2.3, 0}, {0.7, 0, 0}, {0, 0, 1}, 4, 2);
    const Meeting meeting = find_meeting(ground, rib, {});
    ASSERT_EQ(meeting.lines.size(), 1u);
    const MeetingLine& line = meeting.lines[0];
    EXPECT_NEAR(length(line), 2.8, 1e-12);
    EXPECT_EQ(std::ranges::count_if(line.points, [](const auto& p) { return p.node[1] >= 0; }), 5);
    for (const auto& p : line.points) {
        EXPECT_NEAR(std::abs(p.normal[0][2]), 1, 1e-12);
        EXPECT_NEAR(std::abs(p.normal[1][1]), 1, 1e-12);
    }
}

TEST(FindMeeting, OfAPlateThatHangsOverEndsAtTheBorder) {
    const Meeting meeting = find_meeting(ground, plate({-1.1, 2.3, 0}, {0.9, 0, 0}, {0, 0, 1}, 9, 1), {});
    ASSERT_EQ(meeting.lines.size(), 1u);
    EXPECT_NEAR(length(meeting.lines[0]), 6, 1e-6);
}

TEST(FindMeeting, OfAPlateThroughAnother) {
    const Meeting meeting = find_meeting(ground, plate({1.2, 2.3, -0.7}, {0.7, 0.1, 0}, {0, 0, 1}, 4, 2), {});
    ASSERT_EQ(meeting.lines.size(), 1u);
    EXPECT_NEAR(length(meeting.lines[0]), 4 * std::hypot(0.7, 0.1), 1e-9);
}

TEST(FindMeeting, WhatNearlyTouchesTouches) {
    const Mesh rib = plate({1.2, 2.3, 0.03}, {0.7, 0, 0}, {0, 0, 1}, 4, 2);
    const Meeting meeting = find_meeting(ground, rib, {});
    ASSERT_EQ(meeting.lines.size(), 1u);
    for (const auto& p : meeting.lines[0].points) EXPECT_NEAR(p.at[2], 0, 1e-12);
    EXPECT_TRUE(find_meeting(ground, rib, 0.01).lines.empty());
    EXPECT_TRUE(find_meeting(ground, plate({1, 2, 3}, {1, 0, 0}, {0, 0, 1}, 2, 2), {}).lines.empty());
}

TEST(FindMeeting, OfTwoSolidsIsTheOutlineOfTheirContact) {
    const Mesh box = checks::grid(6, 5, 2);
    Mesh on = checks::grid(2, 2, 1);
    for (Vec3& x : on.points) x += Vec3(1.3, 1.4, 2);
    const Meeting meeting = find_meeting(box, on, {});
    ASSERT_EQ(meeting.lines.size(), 4u);
    double sum = 0;
    for (const MeetingLine& line : meeting.lines) sum += length(line);
    EXPECT_NEAR(sum, 8, 1e-9);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
