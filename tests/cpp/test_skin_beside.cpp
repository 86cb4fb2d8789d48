// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/skin_beside.h"

#include <gtest/gtest.h>

#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(SkinBeside, WhereAPathLeavesTheMaterial) {
    const Workpiece f = checks::whole_workpiece(checks::grid(4, 4, 4), checks::away);
    const SkinBeside skin = SkinBeside::of_solid(f.d.band);
    const Vec3 top(1.3, 2.4, 4);
    EXPECT_FALSE(skin.exit(top, {1.3, 2.4, 0.5}, 0.3)) << "stays inside";
    EXPECT_FALSE(skin.exit(top, {1.3, 2.4, -0.2}, 0.3)) << "out for less than the length";
    EXPECT_FALSE(skin.exit(top, {1.3, 2.4, 9}, 0.3)) << "leads out from the beginning";
    const auto below = skin.exit(top, {1.3, 2.4, -1}, 0.3);
    ASSERT_TRUE(below);
    EXPECT_LT((*below - Vec3(1.3, 2.4, 0)).norm(), 1e-12);
}

TEST(SkinBeside, OfShellsIsTheirBorder) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, Vec3::UnitX(), Vec3::UnitY(), 4, 4);
    checks::add_plate(mesh, {2, 0, 0}, Vec3::UnitY(), Vec3::UnitZ(), 4, 2);  // across it
    const Workpiece f = checks::whole_workpiece(mesh, checks::away);
    const SkinBeside skin = SkinBeside::of_shells(f.d);
    const Vec3 from(0, 1.3, 0), up = Vec3::UnitZ();
    EXPECT_FALSE(skin.exit(from, {3.5, 1.3, 0}, 0.3, up)) << "past what stands there";
    EXPECT_FALSE(skin.exit({0, 4, 0}, {3.5, 0.01, 0}, 0.3, up)) << "past its corner";
    EXPECT_FALSE(skin.exit(from, {-3, 1.3, 0}, 0.3, up)) << "leads out from the beginning";
    const auto at = skin.exit(from, {5, 1.3, 0}, 0.3, up);
    ASSERT_TRUE(at);
    EXPECT_LT((*at - Vec3(4, 1.3, 0)).norm(), 1e-12);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
