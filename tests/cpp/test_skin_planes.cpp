// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/skin_planes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "operators/feature_line.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();

/// A grid turned in space, with six significant digits; `bend` curves its lower face.
Mesh turned_grid(double bend = 0) {
    Mesh mesh = checks::grid(6, 5, 4);
    for (Vec3& x : mesh.points) {
        x.z() -= bend * x.x() * (6 - x.x());
        x = turn * x + Vec3(7, 11, 13);
        for (int k = 0; k < 3; ++k) {
            char text[32];
            std::snprintf(text, sizeof text, "%.6g", x[k]);
            x[k] = std::strtod(text, nullptr);
        }
    }
    return mesh;
}

bool is_lower(const Mesh& mesh, const std::array<Index, 3>& t) {
    const Vec3 n = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).normalized();
    return n.dot(turn * Vec3(0, 0, -1)) > 0.9;
}

TEST(SkinPlanes, AreMoreExactThanTriangles) {
    const Mesh mesh = turned_grid();
    const auto skin = skin_of(mesh);
    const SkinPlanes planes(mesh, skin);
    int count = 0;
    for (const auto& t : skin) {
        const auto plane = planes.of(t);
        ASSERT_TRUE(plane);
        if (!is_lower(mesh, t)) continue;
        ++count;
        EXPECT_LT((plane->normal - turn * Vec3(0, 0, -1)).norm(), 1e-5);
        EXPECT_NEAR(plane->offset, plane->normal.dot(Vec3(7, 11, 13)), 5e-5);
    }
    EXPECT_EQ(count, 2 * 6 * 5);
}

TEST(SkinPlanes, AreNoneOnCurvedFacesNorWhereNothingWasRounded) {
    // Its facets turn by more than rounding could, little as that is.
    const Mesh bent = turned_grid(1e-3);
    const auto skin = skin_of(bent);
    const SkinPlanes planes(bent, skin);
    for (const auto& t : skin) {
        if (!is_lower(bent, t)) continue;
        const auto plane = planes.of(t);
        if (plane) {
            for (const Index n : t) EXPECT_NEAR(plane->normal.dot(bent.points[n]), plane->offset, 2e-4);
        }
        const auto other = planes.of(skin.back());
        EXPECT_FALSE(plane && other && plane->normal == other->normal);
    }
    const Mesh exact = checks::grid(2, 2, 2);
    EXPECT_FALSE(SkinPlanes(exact, skin_of(exact)).of(skin_of(exact)[0]));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
