// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/cavity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "voxel_skin.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 0.1}};
const std::vector<Triangle> skin = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST(Cavity, VolumeOfATetrahedron) {
    EXPECT_DOUBLE_EQ(enclosed_volume(corners, skin), 1.0 / 6);
    EXPECT_NO_THROW(check_cavity(corners, skin));
}

TEST(Cavity, SharpestEdge) {
    const SharpestEdge edge = sharpest_edge(corners, skin);
    EXPECT_NEAR(edge.degrees, std::acos(1 / std::sqrt(3.0)) * 180 / M_PI, 1e-9);
    // Concave edges are none.
    const auto notched = checks::voxel_skin(2, 2, 1, [](int x, int y, int) { return x == 0 || y == 0; });
    EXPECT_NEAR(sharpest_edge(notched.points, notched.triangles).degrees, 90, 1e-9);
}

TEST(Cavity, FillingIsChecked) {
    EXPECT_NEAR(check_filling(corners, skin, std::vector<Tetra>{{0, 1, 2, 3}}), 0.84, 0.01);
    const std::vector<Tetra> four = {{0, 1, 2, 4}, {0, 3, 1, 4}, {1, 3, 2, 4}, {0, 2, 3, 4}};
    EXPECT_GT(check_filling(corners, skin, four), 0);
    EXPECT_THROW(check_filling(corners, skin, std::vector<Tetra>{{0, 2, 1, 3}}), QualityError) << "inverted";
    EXPECT_THROW(check_filling(corners, skin, std::vector<Tetra>(four.begin(), four.begin() + 3)), QualityError);
    EXPECT_THROW(check_filling(corners, skin, std::vector<Tetra>{}), QualityError);
    EXPECT_THROW(check_filling(corners, skin, std::vector<Tetra>(2, Tetra{0, 1, 2, 3})), QualityError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
