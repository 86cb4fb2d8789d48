// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/bar_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::away;
using checks::node_at;

struct BarNetwork : testing::Test, checks::CubeOfEight {
    double stiffness = 6 + 6 / std::sqrt(2.0) + 2 / std::sqrt(3.0);
};

TEST_F(BarNetwork, CarriesAWholeMotionAlong) {
    std::vector<int> known;
    for (int v = 0; v < d.band.size(); ++v)
        if (v != middle) known.push_back(v);
    const Vec3 shift(0.1, -0.2, 0.3);
    const auto out = bar_network_displacements(d, known, std::vector<Vec3>(known.size(), shift), {middle});
    ASSERT_EQ(out.size(), 1u);
    EXPECT_LT((out[0] - shift).norm(), 1e-15);
}

TEST_F(BarNetwork, WeighsBarsByOneOverTheirLength) {
    const Vec3 shift(0.1, -0.2, 0.3);
    const auto straight = bar_network_displacements(d, {node_at(d.band, {2, 1, 1})}, {shift}, {middle});
    EXPECT_LT((straight[0] - shift / stiffness).norm(), 1e-15);
    const auto diagonal = bar_network_displacements(d, {node_at(d.band, {2, 2, 2})}, {shift}, {middle});
    EXPECT_LT((diagonal[0] - shift / std::sqrt(3.0) / stiffness).norm(), 1e-15);
    const auto none = bar_network_displacements(d, {node_at(d.band, {2, 0, 0})}, {shift}, {middle});
    EXPECT_EQ(none[0], Vec3(0, 0, 0)) << "there is no bar between them";
}

TEST_F(BarNetwork, KeepsNodesToTheirConstraints) {
    // On the face z = 2, on its edge, in its corner; the last two share no bar with the first but by fixed ones.
    const int face = node_at(d.band, {1, 1, 2}), edge = node_at(d.band, {2, 1, 2}), corner = node_at(d.band, {2, 2, 2});
    const auto out = bar_network_displacements(d, {middle}, {Vec3(0.1, 0.2, 0.3)}, {face, edge, corner});
    EXPECT_GT(out[0].x(), 0);
    EXPECT_GT(out[0].y(), 0);
    EXPECT_EQ(out[0].z(), 0);
    EXPECT_NEAR(out[1].x(), 0, 1e-15);
    EXPECT_GT(out[1].y(), 0);
    EXPECT_NEAR(out[1].z(), 0, 1e-15);
    EXPECT_EQ(out[2], Vec3(0, 0, 0));
}

TEST_F(BarNetwork, SolvesForSeveralNodesTogether) {
    // A row of three in a bar of cubes, one end pulled: energies are least where each is the mean of its neighbours.
    mesh = checks::grid(4, 2, 2);
    d = checks::whole_workpiece(mesh, away).d;
    const std::vector<int> row{node_at(d.band, {1, 1, 1}), node_at(d.band, {2, 1, 1}), node_at(d.band, {3, 1, 1})};
    const auto out = bar_network_displacements(d, {node_at(d.band, {4, 1, 1})}, {Vec3(1, 0, 0)}, row);
    for (int k = 0; k < 3; ++k) {
        const double before = k > 0 ? out[k - 1].x() : 0, behind = k < 2 ? out[k + 1].x() : 1;
        EXPECT_NEAR(out[k].x() * stiffness, before + behind, 2e-3);
        EXPECT_GT(out[k].x(), 0);
    }
}

TEST_F(BarNetwork, IsStillWhereNothingIsGiven) {
    const auto out = bar_network_displacements(d, {}, {}, {middle, 0});
    EXPECT_THAT(out, testing::ElementsAre(Vec3(0, 0, 0), Vec3(0, 0, 0)));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
