// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/skin_beside.h"

#include <gtest/gtest.h>

#include "whole_workpiece.h"

namespace femscalpel {
namespace {

TEST(SkinBeside, WhereAPathLeavesTheMaterial) {
    const Workpiece f = checks::whole_workpiece(checks::grid(4, 4, 4), checks::away);
    const SkinBeside skin(f.d.band);
    const Vec3 top(1.3, 2.4, 4);
    EXPECT_FALSE(skin.exit(top, {1.3, 2.4, 0.5}, 0.3)) << "stays inside";
    EXPECT_FALSE(skin.exit(top, {1.3, 2.4, -0.2}, 0.3)) << "out for less than the length";
    EXPECT_FALSE(skin.exit(top, {1.3, 2.4, 9}, 0.3)) << "leads out from the beginning";
    const auto below = skin.exit(top, {1.3, 2.4, -1}, 0.3);
    ASSERT_TRUE(below);
    EXPECT_LT((*below - Vec3(1.3, 2.4, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace femscalpel
