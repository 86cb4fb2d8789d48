// SPDX-License-Identifier: LGPL-2.1-or-later
// What goes with a wall because it is one surface with it, or tangent to it.
#include "cutting/tangent.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "wall_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

Beside beside(const Mesh& mesh, const std::function<bool(const Vec3&)>& chosen) {
    const Workpiece f = checks::whole_workpiece(mesh, checks::away);
    return parts_beside(f, checks::covered_where(mesh, chosen), {}, 30);
}

TEST(Tangent, TheRestOfAPlane) {
    Mesh mesh = checks::grid(3, 2, 2);
    EXPECT_EQ(beside(mesh, [](const Vec3& x) { return x.z() == 2 && x.x() <= 1; }).same.size(), 8U);
    const Beside whole = beside(mesh, [](const Vec3& x) { return x.z() == 2; });
    EXPECT_TRUE(whole.same.empty() && whole.following.empty()) << "beside an edge of the box";
}

/// A block whose top at x > 4 turns upwards in a quarter of a circle of radius 1 around (4, 3) and goes on as a wall.
Mesh with_fillet() {
    Mesh mesh = checks::grid(11, 2, 2);
    for (Vec3& x : mesh.points) {
        const double height = x.z() - 2, along = x.x();
        if (along <= 4) continue;
        const double turn = std::min(1.0, (along - 4) / 4) * std::numbers::pi / 2;
        const Vec3 centre(4, 0, 3), out(std::sin(turn), 0, -std::cos(turn));
        const double y = x.y();
        x = centre + (1 - height) * out;
        if (along > 8) x += (along - 8) * Vec3(0, 0, 1);
        x.y() = y;
    }
    return mesh;
}

TEST(Tangent, AFilletUpToTheFaceAlongWhichItSlides) {
    const Mesh mesh = with_fillet();
    const Beside out = beside(mesh, [](const Vec3& x) { return x.z() == 2 && x.x() <= 4; });
    EXPECT_TRUE(out.same.empty());
    ASSERT_FALSE(out.following.empty());
    EXPECT_EQ(out.following.size(), 16U) << "four by two pairs of triangles, not those of the wall behind";
    for (const auto& part : out.following)
        for (const Index n : part) EXPECT_NEAR((mesh.points[n] - Vec3(4, mesh.points[n].y(), 3)).norm(), 1, 1e-9);
}

TEST(Tangent, NotAWallThatGoesOnFar) {
    Mesh mesh = checks::grid(8, 2, 1);
    for (Vec3& x : mesh.points) x.z() += 0.02 * x.x() * x.x();
    try {
        beside(mesh, [](const Vec3& x) { return x.x() <= 1 && x.z() >= 1 && x.z() < 1.1; });
        FAIL();
    } catch (const ToolError& e) {
        EXPECT_STREQ(e.parameter(), "group");
        EXPECT_THAT(e.what(), testing::HasSubstr("goes on smoothly"));
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
