// SPDX-License-Identifier: LGPL-2.1-or-later
// Folded second-order elements where two meshes were joined.
#include "operators/unfold.h"

#include <gtest/gtest.h>

#include "deformation/mid_sides.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

double least_ratio(const Mesh& mesh) {
    double out = 1;
    const CellBlock& block = mesh.block(CellType::tetra10);
    for (Index c = 0; c < block.size(); ++c) {
        std::vector<Vec3> points;
        for (const Index n : block.nodes(c)) points.push_back(mesh.points[n]);
        out = std::min(out, integration_ratio(points));
    }
    return out;
}

/// Second-order cubes, in which the mid-side node at a place is moved by so much.
Mesh bent(const Vec3& at, const Vec3& by) {
    Mesh mesh = checks::second_order(checks::grid(2, 2, 2));
    mesh.points[checks::number_near(mesh, at)] += by;
    return mesh;
}

const Vec3 inside{1, 1, 0.5}, on_skin{0.5, 0, 0}, far{0.35, 0.6, 0};

TEST(Unfold, StraightensEdgesInside) {
    Mesh mesh = bent(inside, far);
    ASSERT_LT(least_ratio(mesh), 0);
    unfold(mesh, {&mesh, &mesh});
    EXPECT_EQ(mesh.points, bent(inside, Vec3::Zero()).points);
}

TEST(Unfold, LeavesSoundCurvesAlone) {
    Mesh mesh = bent(inside, {0.05, 0.02, 0});
    const Mesh before = mesh;
    unfold(mesh, {&before, &before});
    EXPECT_EQ(mesh.points, before.points);
}

TEST(Unfold, MovesNothingOfTheSkinNorOfGroups) {
    const Mesh straight = bent(inside, Vec3::Zero());
    Mesh skin = bent(on_skin, {0, 0.6, 0.3}), group = bent(inside, far), border = bent(inside, far);
    const FamilyIndex held = checks::family_of(group, "HELD", GroupKind::node);
    group.node_families[checks::number_near(straight, inside)] = held;
    const FamilyIndex half = checks::family_of(border, "HALF", GroupKind::element);
    CellBlock& block = border.block(CellType::tetra10);
    for (Index c = 0; c < block.size(); ++c) {
        double x = 0;
        for (const Index n : block.nodes(c).first(4)) x += straight.points[n][0] / 4;
        if (x < 1) block.families[c] = half;
    }
    for (Mesh* mesh : {&skin, &group, &border}) {
        ASSERT_LT(least_ratio(*mesh), 0);
        EXPECT_THROW(unfold(*mesh, {&straight, &straight}), QualityError);
        // What was so before is not the seam's fault.
        const Mesh before = *mesh;
        EXPECT_NO_THROW(unfold(*mesh, {&straight, &before}));
        EXPECT_EQ(mesh->points, before.points);
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
