// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/stress_intensity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fracture/auxiliary_field.h"
#include "fracture/crack_lips.h"
#include "fracture/deck_limits.h"
#include "fracture/front.h"
#include "fracture/interaction_integral.h"
#include "fracture/lip_displacements.h"
#include "fracture/quadrature.h"
#include "short_number.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

constexpr Elasticity solid{210e3, 0.3, false}, sheet{210e3, 0.3, true};

TEST(AuxiliaryField, IsElastic) {
    for (const Elasticity& e : {solid, sheet})
        for (int mode = 1; mode <= (e.plane_stress ? 2 : 3); ++mode)
            for (double theta = -3.1; theta < 3.14; theta += 0.2) {
                const AuxiliaryField f = auxiliary_field(mode, 0.7, theta, e);
                const Eigen::Matrix3d stress = e.stress((f.gradient + f.gradient.transpose()) / 2);
                EXPECT_LT((stress - f.stress).norm(), 1e-12 * f.stress.norm()) << mode << " " << theta;
                const double t = 1e-6;  // and its gradient is that of its displacement
                const AuxiliaryField there = auxiliary_field(mode, 0.7 + t, theta, e);
                const Vec3 along = f.gradient * Vec3(std::cos(theta), std::sin(theta), 0);
                EXPECT_LT(((there.displacement - f.displacement) / t - along).norm(), 1e-5 * along.norm());
            }
}

TEST(AuxiliaryField, LeavesTheLipsFree) {
    for (int mode = 1; mode <= 3; ++mode)
        for (const double theta : {-std::numbers::pi, std::numbers::pi})
            EXPECT_LT(auxiliary_field(mode, 0.3, theta, solid).stress.col(1).norm(), 1e-15);
}

TEST(Quadrature, FillsElements) {
    const std::pair<CellType, double> sizes[] = {{CellType::triangle6, 0.5},   {CellType::quad, 4},
                                                 {CellType::tetra10, 1.0 / 6}, {CellType::wedge, 1},
                                                 {CellType::pyramid, 4.0 / 3}, {CellType::hexahedron20, 8}};
    for (const auto& [type, size] : sizes) {
        double sum = 0;
        for (const QuadraturePoint& p : quadrature(type)) {
            sum += p.weight;
            EXPECT_NEAR(p.values.sum(), 1, 1e-12);
            EXPECT_LT(p.derivatives.colwise().sum().norm(), 1e-11);
        }
        EXPECT_NEAR(sum, size, 1e-12) << traits(type).name;
    }
}

/// A circle of radius 2 in the plane z = 0, the crack inside.
CrackFront circle(int n) {
    std::vector<Vec3> points, ahead, normals;
    for (int k = 0; k <= n; ++k) {
        const double angle = 2 * std::numbers::pi * (k % n) / n;
        points.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), 0);
        ahead.push_back(points.back());
        normals.push_back(Vec3::UnitZ());
    }
    return {points, ahead, normals};
}

TEST(CrackFront, FollowsACircle) {
    const CrackFront front = circle(24);
    EXPECT_TRUE(front.closed());
    EXPECT_NEAR(front.length(), 4 * std::numbers::pi, 1e-4);
    CrackFront::Place at;
    for (double angle = 0; angle < 6.28; angle += 0.17)
        for (const double r : {1.7, 2.0, 2.4}) {
            ASSERT_TRUE(front.find({r * std::cos(angle), r * std::sin(angle), 0.1}, 0.6, at));
            EXPECT_NEAR(at.x1, r - 2, 1e-4);
            EXPECT_NEAR(at.x2, 0.1, 1e-12);
            EXPECT_NEAR(at.curvature, 0.5, 0.01);
            EXPECT_NEAR(at.frame.determinant(), 1, 1e-12);
            EXPECT_NEAR(std::abs(front.along(0, at.s)), 2 * std::min(angle, 2 * std::numbers::pi - angle), 1e-3);
        }
    EXPECT_FALSE(front.find({0.5, 0, 0}, 0.6, at));
}

TEST(CrackFront, TurnsSoThatItsFrameIsRightHanded) {
    for (const double way : {1.0, -1.0}) {
        const CrackFront front({{0, 0, 0}, {0, 0, way}, {0, 0, 2 * way}}, {3, Vec3::UnitX()}, {3, Vec3::UnitY()});
        CrackFront::Place at;
        ASSERT_TRUE(front.find({0.3, 0.4, 0.7 * way}, 1, at));
        EXPECT_NEAR(at.x1, 0.3, 1e-12);
        EXPECT_NEAR(at.x2, 0.4, 1e-12);
        EXPECT_EQ(at.curvature, 0);
        EXPECT_LT((at.frame - Eigen::Matrix3d::Identity()).norm(), 1e-12);
        EXPECT_EQ(front.points().front().z() < front.points().back().z(), true);
    }
}

TEST(CrackLips, NamesWhatIsMissing) {
    const auto message = [](const Mesh& mesh, const std::string& front) {
        try {
            crack_lips(mesh, front);
        } catch (const Error& e) {
            EXPECT_STREQ(e.parameter(), "front");
            return std::string(e.what());
        }
        return std::string();
    };
    Mesh mesh = checks::grid(1, 1, 1);
    EXPECT_THAT(message(mesh, "CRACK"), testing::HasSubstr("NAME_FRONT"));
    EXPECT_THAT(message(mesh, "CRACK_FRONT"), testing::HasSubstr("no element group 'CRACK_FRONT'"));
    mesh.add_group("CRACK_FRONT", GroupKind::element);
    EXPECT_THAT(message(mesh, "CRACK_FRONT"), testing::HasSubstr("no element group 'CRACK_P'"));
}

TEST(ShortNumber, HasFourDigits) { EXPECT_EQ(short_number(1.0 / 3), "0.3333"); }

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
