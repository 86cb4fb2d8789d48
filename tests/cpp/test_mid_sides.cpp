// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/mid_sides.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// A triangle (0 1 2) with the edge 0-1 bent by (0, 0.2, 0).
struct MidSidesTest : testing::Test {
    static Mesh triangle() {
        Mesh mesh;
        for (const Vec3& at :
             {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(1, 0.2, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
            mesh.add_node(at, mesh.node_count() + 1);
        mesh.add_cell(CellType::triangle6, std::array<Index, 6>{0, 1, 2, 3, 4, 5}, 1);
        return mesh;
    }

    Mesh mesh = triangle();
    BandMesh band = extract_band(mesh, {0, 0, 0, 0, 0, 0});
    MidSides mids{band, mesh};
};

TEST_F(MidSidesTest, AreHowFarEdgesAreBent) {
    EXPECT_TRUE(mids.any());
    EXPECT_EQ(mids.bulge(0, 1), Vec3(0, 0.2, 0));
    EXPECT_EQ(mids.bulge(1, 0), Vec3(0, 0.2, 0));
    EXPECT_TRUE(mids.bulge(1, 2).isZero(0));
    EXPECT_TRUE(mids.may_bulge(0, 1));
    EXPECT_FALSE(mids.may_bulge(0, 2));
    EXPECT_TRUE(MidSides(band, mesh, 0.3).bulge(0, 1).isZero(0)) << "by less than rounding";
    const Mesh linear = checks::grid(1, 1, 1);
    EXPECT_FALSE(MidSides(extract_band(linear, std::vector<std::int8_t>(8, 0)), linear).any());
}

TEST_F(MidSidesTest, OfEdgesInsideFollowTheShapeFunctions) {
    // At a quarter of 0-1, half way to 2: 4 l0 l1 = 4 (3/8) (1/8) of the bend, less half of what it is at the end,
    // 4 (3/4) (1/4).
    EXPECT_LT((mids.bulge_across(0, 1, 2, 0.25) - Vec3(0, (3.0 / 16 - 3.0 / 8) * 0.2, 0)).norm(), 1e-16);
    mids.split(band, 0, 1, 3, 0.25);
    EXPECT_LT((mids.bulge(3, 2) - Vec3(0, -3.0 / 16 * 0.2, 0)).norm(), 1e-16);
    EXPECT_LT((mids.bulge(0, 3) - Vec3(0, 0.2 / 16, 0)).norm(), 1e-16);
    EXPECT_LT((mids.bulge(3, 1) - Vec3(0, 9 * 0.2 / 16, 0)).norm(), 1e-16);
}

TEST_F(MidSidesTest, AreMendedAndPutBack) {
    mids.mend(0, 1, Vec3(0, 0.1, 0));
    mids.mend(0, 1, Vec3::Zero());
    mids.mend(1, 2, Vec3(0.3, 0, 0));
    EXPECT_TRUE(mids.is_mended(1, 0));
    EXPECT_EQ(mids.mended().size(), 2u);
    EXPECT_EQ(mids.mended().at(edge_key(0, 1)), Vec3(0, 0.2, 0)) << "as it was in the input";
    EXPECT_TRUE(mids.bulge(0, 1).isZero(0));
    mids.put_back(0, 1);
    mids.put_back(1, 2);
    EXPECT_FALSE(mids.is_mended(0, 1));
    EXPECT_EQ(mids.bulge(0, 1), Vec3(0, 0.2, 0));
    EXPECT_TRUE(mids.bulge(1, 2).isZero(0));
    mids.put_back(0, 2);  // nothing to be put back
    EXPECT_TRUE(mids.mended().empty());
}

TEST(Fraction, IsAlongTheChord) {
    EXPECT_EQ(fraction({0, 0, 0}, {4, 0, 0}, {1, 5, -3}), 0.25);
    EXPECT_EQ(fraction({0, 0, 0}, {4, 0, 0}, {-1, 0, 0}), 0);
    EXPECT_EQ(fraction({0, 0, 0}, {4, 0, 0}, {9, 0, 0}), 1);
}

/// Straight elements whose mid-side node of the edge 0-1 is off along it, by `shift` of its length.
std::array<Vec3, 10> tetra10(double shift) {
    std::array<Vec3, 10> x{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 3, 0), Vec3(1, 1, 4)};
    constexpr int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    for (int k = 0; k < 6; ++k) x[4 + k] = (x[ends[k][0]] + x[ends[k][1]]) / 2;
    x[4].x() += 2 * shift;
    return x;
}
std::array<Vec3, 6> triangle6(double shift) {
    return {Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(0, 0, 4), Vec3(1 + 2 * shift, 0, 1), Vec3(1, 0, 2.5), Vec3(0, 0, 2.5)};
}

TEST(CurvedRatio, IsThatOfTheSmallestJacobian) {
    EXPECT_DOUBLE_EQ(curved_ratio(tetra10(0)), 1);
    EXPECT_DOUBLE_EQ(curved_ratio(triangle6(0)), 1);
    // Along the edge the Jacobian is 1 + 4 shift (l0 - l1).
    for (const double shift : {0.1, -0.2, 0.3}) {
        EXPECT_NEAR(curved_ratio(tetra10(shift)), 1 - 4 * std::abs(shift), 1e-14);
        EXPECT_NEAR(curved_ratio(triangle6(shift)), 1 - 4 * std::abs(shift), 1e-14);
        EXPECT_NEAR(integration_ratio(tetra10(shift)), 1 - 4 * std::abs(shift) / std::sqrt(5.0), 1e-14);
        EXPECT_NEAR(integration_ratio(triangle6(shift)), 1 - 4 * std::abs(shift) / 2, 1e-14);
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
