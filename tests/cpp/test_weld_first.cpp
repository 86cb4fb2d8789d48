// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/weld_first.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "operators/crack.h"
#include "simple_meshes.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::grid;

/// A box of tetrahedra, parted at x = 5 by a crack.
Mesh parted() {
    CrackOptions options;
    options.name = "OLD";
    return crack(grid(10, 5, 4), Plane({5, 0, 0}, {1, 0, 0}), options).mesh;
}

TEST(WeldFirst, OnlyWhereThereIsSomethingNear) {
    const Mesh whole = grid(10, 5, 4);
    EXPECT_FALSE(WeldFirst(whole, {}));
    const Mesh mesh = parted();
    const WeldFirst weld(mesh, {});
    ASSERT_TRUE(weld);
    const Plane near({5.2, 0, 0}, {1, 0.3, 0}), far({500, 0, 0}, {1, 0, 0});
    std::vector<Blade> blades(1);
    blades[0].tool = &near;
    EXPECT_TRUE(weld.is_near(blades));
    blades[0].tool = &far;
    EXPECT_FALSE(weld.is_near(blades));
}

TEST(WeldFirst, ACrackAcrossAnEarlierOneMatchesNodeForNode) {
    const Mesh mesh = parted();
    const Result result = crack(mesh, Plane({5, 2, 2}, {0.2, 1, 0.3}), {});
    EXPECT_GT(result.report.welded_pairs, 10);
    EXPECT_EQ(result.report.seconds.front().first, "weld");
    for (const std::string& w : result.report.warnings)
        EXPECT_THAT(w, testing::Not(testing::HasSubstr("lie on each other")));
    // Each node of the old lips has one of the other lip at its place.
    std::map<std::array<double, 3>, std::array<int, 2>> at;
    for (int side = 0; side < 2; ++side) {
        const auto group = result.mesh.find_group(side ? "OLD_P" : "OLD_N", GroupKind::element);
        ASSERT_TRUE(group);
        const CellBlock& b = result.mesh.block(CellType::triangle);
        for (Index c = 0; c < b.size(); ++c)
            if (result.mesh.families.contains(b.families[c], *group))
                for (const Index n : b.nodes(c)) {
                    const Vec3& x = result.mesh.points[n];
                    ++at[{x[0], x[1], x[2]}][static_cast<std::size_t>(side)];
                }
    }
    EXPECT_GT(at.size(), 20u);
    for (const auto& [x, count] : at) EXPECT_TRUE(count[0] > 0 && count[1] > 0) << x[0] << " " << x[1] << " " << x[2];
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
