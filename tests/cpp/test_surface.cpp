// SPDX-License-Identifier: LGPL-2.1-or-later
// Faces of a mesh's surface, and what is near them.
#include "mesh/surface.h"

#include <gtest/gtest.h>

#include "mesh/surface_tree.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

Eigen::AlignedBox3d everything(const Mesh& mesh) { return box_around(mesh); }

TEST(Surface, OfASolidIsItsSkinWithNormalsOutwards) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const auto faces = surface_near(mesh, everything(mesh));
    EXPECT_EQ(faces.size(), 6 * 8u);
    const Vec3 middle(1, 1, 1);
    for (const SurfaceFace& f : faces) {
        EXPECT_FALSE(f.shell);
        const Vec3 &a = mesh.points[f.nodes[0]], &b = mesh.points[f.nodes[1]], &c = mesh.points[f.nodes[2]];
        EXPECT_GT((b - a).cross(c - a).dot(a - middle), 0);
    }
}

TEST(Surface, NearABoxIsWhatReachesIntoIt) {
    const Mesh mesh = checks::grid(4, 1, 1);
    const auto faces = surface_near(mesh, {Vec3(3.4, -1, -1), Vec3(9, 9, 9)});
    EXPECT_EQ(faces.size(), 4 * 2 + 2u);  // four sides of the last cube, and the end
}

TEST(Surface, HasShellsButNotTrianglesOnSolids) {
    Mesh mesh = checks::grid(1, 1, 1);
    checks::add_plate(mesh, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    const std::size_t on_skin = surface_near(mesh, everything(mesh)).size();
    checks::add_plate(mesh, {0, 0, 1}, {1, 0, 0}, {0, 0, 1}, 1, 1);
    const auto faces = surface_near(mesh, everything(mesh));
    EXPECT_EQ(std::ranges::count_if(faces, &SurfaceFace::shell), static_cast<int>(faces.size() - 12));
    EXPECT_GE(faces.size(), on_skin + 2);
}

TEST(SurfaceTree, FindsTheClosestPointAndItsSide) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const auto faces = surface_near(mesh, everything(mesh));
    const SurfaceTree tree(mesh, faces);
    EXPECT_NEAR((tree.closest({0.7, 0.6, 3}).at - Vec3(0.7, 0.6, 2)).norm(), 0, 1e-12);
    EXPECT_NEAR(tree.signed_distance({0.7, 0.6, 3}), 1, 1e-12);
    EXPECT_NEAR(tree.signed_distance({0.7, 0.6, 1.8}), -0.2, 1e-12);
    EXPECT_NEAR(tree.signed_distance({3, 3, 3}), std::sqrt(3), 1e-12);  // before a corner
    EXPECT_NEAR(tree.signed_distance({1, 1, 1}), -1, 1e-12);
}

TEST(SurfaceTree, ABoxIsBorderedByItsEdges) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const auto faces = surface_near(mesh, everything(mesh));
    const SurfaceTree tree(mesh, faces);
    EXPECT_EQ(tree.border().size(), 12 * 2u);
    const SurfaceTree::Foot foot = tree.closest_on_border({1, 0.2, 2.1});
    EXPECT_NEAR((foot.at - Vec3(1, 0, 2)).norm(), 0, 1e-12);
    EXPECT_NEAR((tree.border_normal(foot.piece) - Vec3(0, -1, 1).normalized()).norm(), 0, 1e-12);
}

TEST(SurfaceTree, AShellIsBorderedByEdgesOfOneTriangle) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 2);
    const auto faces = surface_near(mesh, everything(mesh));
    const SurfaceTree tree(mesh, faces);
    EXPECT_EQ(tree.border().size(), 10u);
    EXPECT_DOUBLE_EQ(tree.sag(0), 0);
    EXPECT_NEAR(std::abs(tree.normal(0)[2]), 1, 1e-12);
}

TEST(SurfaceTree, KnowsHowFarACurvedSurfaceIsOffItsFaces) {
    // Strips around a circle of radius 10, of 10 degrees each.
    Mesh mesh;
    const auto at = [](int k, double y) { return Vec3(10 * std::cos(k * M_PI / 18), y, 10 * std::sin(k * M_PI / 18)); };
    for (int k = 0; k < 6; ++k) checks::add_plate(mesh, at(k, 0), at(k + 1, 0) - at(k, 0), {0, 2, 0}, 1, 1);
    const auto faces = surface_near(mesh, everything(mesh));
    const SurfaceTree tree(mesh, faces);
    const double off = 10 * (1 - std::cos(5 * M_PI / 180));
    EXPECT_GT(tree.sag(4), 0.7 * off);
    EXPECT_LT(tree.sag(4), 2 * off);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
