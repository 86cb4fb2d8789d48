// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/feature_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(FeatureLine, SkinOfABox) { EXPECT_EQ(skin_of(checks::grid(2, 3, 4)).size(), 2u * 2 * (2 * 3 + 3 * 4 + 4 * 2)); }

TEST(FeatureLine, EdgeOfABoxByPointNodesAndGroup) {
    Mesh mesh = checks::grid(4, 2, 3);
    const auto lines = find_feature_lines(mesh, {{}, {}, {{2, -0.1, 0.2}}}, 30);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].nodes.size(), 5u);
    EXPECT_FALSE(lines[0].closed);
    EXPECT_FALSE(lines[0].extended);
    for (const Index n : lines[0].nodes) EXPECT_EQ(mesh.points[n].tail<2>().norm(), 0);
    // The first face runs along the line, the second against it.
    for (std::size_t e = 0; e < lines[0].faces.size(); ++e) {
        const auto runs = [&](int side, Index a, Index b) {
            const auto& f = lines[0].faces[e][side];
            return (f[0] == a && f[1] == b) || (f[1] == a && f[2] == b) || (f[2] == a && f[0] == b);
        };
        EXPECT_TRUE(runs(0, lines[0].nodes[e], lines[0].nodes[e + 1]));
        EXPECT_TRUE(runs(1, lines[0].nodes[e + 1], lines[0].nodes[e]));
    }

    const std::vector<Index> two{mesh.node_ids[checks::number_near(mesh, {1, 0, 0})],
                                 mesh.node_ids[checks::number_near(mesh, {2, 0, 0})]};
    const auto longer = find_feature_lines(mesh, {{}, two, {}}, 30);
    ASSERT_EQ(longer.size(), 1u);
    EXPECT_EQ(longer[0].nodes.size(), 5u);
    EXPECT_TRUE(longer[0].extended);

    const FamilyIndex family = checks::family_of(mesh, "EDGE", GroupKind::node);
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (mesh.points[n].tail<2>().norm() == 0) mesh.node_families[n] = family;
    EXPECT_FALSE(find_feature_lines(mesh, {"EDGE", {}, {}}, 30).at(0).extended);
}

TEST(FeatureLine, WhatIsNoEdge) {
    const Mesh mesh = checks::two_halves();
    const auto reason = [&](const Along& along) {
        try {
            find_feature_lines(mesh, along, 30);
        } catch (const ToolError& e) {
            EXPECT_STREQ(e.parameter(), "along");
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_THAT(reason({"NONE", {}, {}}), testing::HasSubstr("no group 'NONE'"));
    EXPECT_THAT(reason({"LEFT", {}, {}}), testing::HasSubstr("elements other than segments"));
    EXPECT_THAT(reason({{}, {999999}, {}}), testing::HasSubstr("no node 999999"));
    EXPECT_THAT(reason({{}, {mesh.node_ids[0]}, {}}), testing::HasSubstr("are no edge"));
    EXPECT_THAT(reason({}), testing::HasSubstr("nothing is named"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
