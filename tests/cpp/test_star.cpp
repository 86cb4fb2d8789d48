// SPDX-License-Identifier: LGPL-2.1-or-later
// The elements around a node as functions of its place, against mean ratios and differences.
#include "deformation/star.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

const Plane away({100, 0, 0}, {1, 0, 0});

struct StarTest : testing::Test {
    void use(const Mesh& m, const Vec3& at) {
        mesh = m;
        d.emplace(checks::whole_workpiece(mesh, away).d);
        node = checks::node_at(d->band, at);
        star.gather(*d, node);
    }
    /// Qualities of the elements, were the node there.
    std::vector<double> qualities(const Vec3& x) {
        const Vec3 home = std::exchange(d->band.nodes[node].at, x);
        std::vector<double> out;
        for (const int t : d->band.tetras.around(node)) out.push_back(tetra_quality(*d, t));
        for (const int t : d->band.triangles.around(node))
            if (d->constraints.is_shell(d->band.triangles.origin(t))) out.push_back(shell_quality(*d, t));
        d->band.nodes[node].at = home;
        return out;
    }
    void expect_values_at(const Vec3& x) {
        double sum = 0, worst = 1;
        for (const double q : qualities(x)) {
            sum += std::pow(q, -8);
            worst = std::min(worst, q);
        }
        EXPECT_NEAR(star.worst(x), worst, 1e-13);
        EXPECT_NEAR(star.value(x, 3) / sum, 1, 1e-12);
        Vec3 gradient;
        Eigen::Matrix3d hessian;
        EXPECT_NEAR(star.derivatives(x, 3, gradient, hessian) / sum, 1, 1e-12);
        constexpr double step = 1e-5;
        for (int k = 0; k < 3; ++k) {
            const Vec3 e = step * Vec3::Unit(k);
            EXPECT_NEAR(gradient[k], (star.value(x + e, 3) - star.value(x - e, 3)) / (2 * step),
                        1e-6 * (1 + std::abs(gradient.norm())));
            Vec3 after, before;
            Eigen::Matrix3d unused;
            star.derivatives(x + e, 3, after, unused);
            star.derivatives(x - e, 3, before, unused);
            EXPECT_LT((hessian.col(k) - (after - before) / (2 * step)).norm(), 1e-5 * (1 + hessian.norm()));
        }
    }

    Mesh mesh;
    std::optional<Deformable> d;
    int node = -1;
    Star star;
};

TEST_F(StarTest, OfTetrahedra) {
    use(checks::grid(2, 2, 2), {1, 1, 1});
    EXPECT_FALSE(star.empty());
    expect_values_at({1, 1, 1});
    expect_values_at({1.3, 0.8, 1.1});
    EXPECT_TRUE(std::isinf(star.value({2.5, 1, 1}, 3))) << "elements would be inverted";
    EXPECT_EQ(star.worst({2.5, 1, 1}), 0);
}

TEST_F(StarTest, OfShells) {
    Mesh plate;
    checks::add_plate(plate, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
    use(plate, {1, 1, 0});
    expect_values_at({1, 1, 0});
    expect_values_at({1.3, 0.8, 0});
}

TEST_F(StarTest, DoesNotCountTrianglesOnTetrahedra) {
    Mesh cube = checks::grid(1, 1, 1);
    checks::add_plate(cube, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1);
    use(cube, {0, 0, 0});
    expect_values_at({0.1, 0.05, -0.1});
}

TEST(Star, IsEmptyAtANodeOfSegmentsAlone) {
    Mesh mesh;
    for (int k = 0; k < 2; ++k) mesh.add_node(Vec3(k, 0, 0), k + 1);
    mesh.add_cell(CellType::line, std::array<Index, 2>{0, 1}, 1);
    Star star;
    star.gather(checks::whole_workpiece(mesh, away).d, 0);
    EXPECT_TRUE(star.empty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
