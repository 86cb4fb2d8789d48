// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fields/reference_element.h"

#include <gtest/gtest.h>

#include <numeric>

#include "random_numbers.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::Random;

double between(Random& random, double low, double high) {
    return low + (high - low) * static_cast<double>(random.bits() % 1000001) / 1e6;
}

/// A point inside.
Eigen::VectorXd some_point(const ReferenceElement& element, Random& random) {
    Eigen::VectorXd at(element.nodes().rows());
    do
        for (double& x : at) x = between(random, -1, 1);
    while (element.inside(at) < 0.02);
    return at;
}

TEST(ReferenceElement, FunctionsAreOneAtTheirNodeAndAddUpToOne) {
    Random random(1);
    for (const CellTraits& t : all_cell_types()) {
        const ReferenceElement& element = ReferenceElement::of(t.type);
        ASSERT_EQ(element.nodes().cols(), t.nodes) << t.name;
        for (int k = 0; k < t.nodes; ++k) {
            const Eigen::VectorXd values = element.values(element.nodes().col(k));
            EXPECT_LT((values - Eigen::VectorXd::Unit(t.nodes, k)).cwiseAbs().maxCoeff(), 1e-14) << t.name << " " << k;
            const double inside = element.inside(element.nodes().col(k));
            EXPECT_TRUE(t.dimension == 0 || std::abs(inside) < 1e-15 || (k >= t.corners && inside < 0.6)) << inside;
        }
        if (t.dimension == 0) continue;
        for (int k = 0; k < 20; ++k) {
            const Eigen::VectorXd at = some_point(element, random), values = element.values(at);
            EXPECT_NEAR(values.sum(), 1, 1e-14) << t.name;
            EXPECT_LT((element.nodes() * values - at).norm(), 1e-14) << t.name << ": linear fields are kept";
            const Eigen::MatrixXd slopes = element.derivatives(at);
            constexpr double step = 1e-6;
            for (int a = 0; a < t.dimension; ++a) {
                const Eigen::VectorXd way = step * Eigen::VectorXd::Unit(t.dimension, a);
                const Eigen::VectorXd expected = (element.values(at + way) - element.values(at - way)) / (2 * step);
                EXPECT_LT((slopes.col(a) - expected).norm(), 1e-8) << t.name << " " << a;
            }
        }
    }
}

TEST(ReferenceElement, MiddleNodesStandAsOurTypesHaveThem) {
    const auto& hexa = ReferenceElement::of(CellType::hexahedron27).nodes();
    // VTK: x-, x+, y-, y+, z-, z+, the middle.
    const double centres[][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 0, 0}};
    for (int k = 0; k < 7; ++k)
        for (int a = 0; a < 3; ++a) EXPECT_EQ(hexa(a, 20 + k), centres[k][a]) << k;
    EXPECT_EQ(ReferenceElement::of(CellType::hexahedron20).nodes().col(12), Eigen::Vector3d(0, -1, 1));
}

TEST(ReferenceElement, FindsPointsInElementsOfEveryTypeAlsoCurvedOnes) {
    Random random(2);
    for (const CellTraits& t : all_cell_types()) {
        if (t.dimension == 0) continue;
        const ReferenceElement& element = ReferenceElement::of(t.type);
        for (int round = 0; round < 20; ++round) {
            // The reference element turned, stretched and, by its middle nodes, bent a little.
            Eigen::Matrix3d turn;
            for (double& x : turn.reshaped()) x = between(random, -0.4, 0.4);
            turn += 2 * Eigen::Matrix3d::Identity();
            Mesh mesh;
            std::vector<Index> nodes(static_cast<std::size_t>(t.nodes));
            std::iota(nodes.begin(), nodes.end(), 0);
            for (int k = 0; k < t.nodes; ++k) {
                Vec3 at = Vec3::Zero();
                at.head(t.dimension) = element.nodes().col(k);
                at = turn * at + Vec3(10, -20, 5);
                if (k >= t.corners || t.type == CellType::hexahedron)
                    for (int a = 0; a < t.dimension; ++a) at += turn.col(a) * between(random, -0.04, 0.04);
                mesh.add_node(at, k + 1);
            }
            mesh.add_cell(t.type, nodes, 1);
            const Eigen::VectorXd inside = some_point(element, random), shares = element.values(inside);
            Vec3 point = Vec3::Zero();
            for (int k = 0; k < t.nodes; ++k) point += shares[k] * mesh.points[static_cast<std::size_t>(k)];
            const auto found = find_in_element(mesh, {t.type, 0}, point);
            ASSERT_TRUE(found) << t.name;
            EXPECT_LT((found->at - inside).norm(), 1e-11) << t.name;
            EXPECT_LT((found->shares - shares).norm(), 1e-11) << t.name;
            EXPECT_GT(found->inside, 0) << t.name;
            EXPECT_NEAR(found->cornered.sum(), 1, 1e-12) << t.name;
        }
    }
}

TEST(ReferenceElement, TakesPointsOutsideToTheNearestInside) {
    for (const CellTraits& t : all_cell_types()) {
        if (t.dimension == 0) continue;
        const ReferenceElement& element = ReferenceElement::of(t.type);
        for (const double far : {-3., 3.}) {
            const Eigen::VectorXd at = Eigen::VectorXd::Constant(t.dimension, far);
            EXPECT_LT(element.inside(at), -0.5) << t.name;
            EXPECT_NEAR(element.inside(element.clamped(at)), 0, 1e-15) << t.name;
        }
        const Eigen::VectorXd middle = element.nodes().leftCols(t.corners).rowwise().mean();
        EXPECT_EQ(element.clamped(middle), middle) << t.name;
    }
}

TEST(ReferenceElement, ElementsOfNoSizeHaveNoPoints) {
    Mesh mesh;
    for (int k = 0; k < 4; ++k) mesh.add_node(Vec3(k % 2, 0, 0), k + 1);
    mesh.add_cell(CellType::tetra, std::vector<Index>{0, 1, 2, 3}, 1);
    mesh.add_cell(CellType::line, std::vector<Index>{0, 2}, 2);
    mesh.add_cell(CellType::vertex, std::vector<Index>{0}, 3);
    for (const CellType type : {CellType::tetra, CellType::line, CellType::vertex})
        EXPECT_FALSE(find_in_element(mesh, {type, 0}, Vec3(0.5, 0, 0)));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
