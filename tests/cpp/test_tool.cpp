// SPDX-License-Identifier: LGPL-2.1-or-later
// What a new tool has without saying more than its distance and normal.
#include "tools/tool.h"

#include <gtest/gtest.h>

#include <limits>

namespace femscalpel {
namespace FILE_NAMESPACE {

/// The plane z = 1.
struct Ground : Tool {
    std::string kind() const override { return "ground"; }
    double distance(const Eigen::Vector3d& x) const override { return x.z() - 1; }
    Eigen::Vector3d normal(const Eigen::Vector3d&) const override { return {0, 0, 1}; }
    double feature_size() const override { return std::numeric_limits<double>::infinity(); }
};

TEST(Tool, ProjectsAlongItsNormalAndHasNoBorder) {
    const Ground ground;
    EXPECT_EQ(ground.project({3, 4, -5}), Eigen::Vector3d(3, 4, 1));
    EXPECT_FALSE(ground.bounded());
    EXPECT_EQ(ground.beyond({1e9, 0, 0}), -std::numeric_limits<double>::infinity());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
