// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/quality.h"
#include "operators/fillet_cavity.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace {

double volume(const Mesh& mesh) {
    double sum = 0;
    for (const CellType type : {CellType::tetra, CellType::tetra10})
        for (Index c = 0; c < mesh.block(type).size(); ++c) sum += cell_measure(mesh, type, c);
    return sum;
}

double worst(const Mesh& mesh) {
    double out = 1;
    for (const double q : mean_ratios(mesh, CellType::tetra)) out = std::min(out, q);
    return out;
}

TEST(Fillet, EdgeOfABox) {
    const Mesh mesh = checks::grid(6, 4, 4);
    const Result result = fillet(mesh, {{}, {}, {{3, 0, 0}}}, 1.5);
    result.mesh.validate();
    const double removed = (1 - M_PI / 4) * 1.5 * 1.5 * 6;
    EXPECT_NEAR(volume(mesh) - volume(result.mesh), removed, 0.03 * removed);
    EXPECT_GT(worst(result.mesh), 0.15);
    const auto face = result.mesh.find_group("FILLET_FACE", GroupKind::element);
    ASSERT_TRUE(face);
    double area = 0;
    const CellBlock& triangles = result.mesh.block(CellType::triangle);
    for (Index c = 0; c < triangles.size(); ++c) {
        ASSERT_TRUE(result.mesh.families.contains(triangles.families[c], *face));
        area += cell_measure(result.mesh, CellType::triangle, c);
        for (const Index n : triangles.nodes(c)) {
            const Vec3& x = result.mesh.points[n];
            EXPECT_NEAR(std::hypot(x.y() - 1.5, x.z() - 1.5), 1.5, 1e-9);
        }
    }
    EXPECT_NEAR(area, 6 * 1.5 * M_PI / 2, 0.01 * area);
}

TEST(Fillet, ElementsThatAreReplacedLeaveTheirGroupsToTheNewOnes) {
    Mesh mesh = checks::grid(4, 4, 4);
    const FamilyIndex all = checks::family_of(mesh, "ALL", GroupKind::element);
    for (FamilyIndex& f : mesh.block(CellType::tetra).families) f = all;
    const Result result = fillet(mesh, {{}, {}, {{2, 0, 0}}}, 1);
    EXPECT_EQ(static_cast<Index>(checks::members(result.mesh, "ALL", GroupKind::element).size()),
              result.mesh.block(CellType::tetra).size());
}

/// Volume of an element group's tetrahedra.
double volume_of(const Mesh& mesh, const char* name) {
    double sum = 0;
    const auto group = mesh.find_group(name, GroupKind::element);
    const CellBlock& b = mesh.block(CellType::tetra);
    for (Index c = 0; c < b.size(); ++c)
        if (mesh.families.contains(b.families[c], *group)) sum += cell_measure(mesh, CellType::tetra, c);
    return sum;
}

TEST(Fillet, BordersOfMaterialsAcrossTheEdgeStayPlane) {
    const Mesh mesh = checks::two_halves();
    const Result result = fillet(mesh, {{}, {}, {{1, 0, 0}}}, 0.5);
    const double left = volume_of(result.mesh, "LEFT"), right = volume_of(result.mesh, "RIGHT");
    EXPECT_NEAR(left, volume(mesh) / 2 - (1 - M_PI / 4) * 0.25, 0.005);
    EXPECT_NEAR(left, right, 1e-3);
    EXPECT_NEAR(left + right, volume(result.mesh), 1e-12);
    const auto group = result.mesh.find_group("LEFT", GroupKind::element);
    const CellBlock& b = result.mesh.block(CellType::tetra);
    for (Index c = 0; c < b.size(); ++c)
        for (const Index n : b.nodes(c)) {
            const double x = result.mesh.points[n].x();
            EXPECT_TRUE(result.mesh.families.contains(b.families[c], *group) ? x < 1 + 1e-9 : x > 1 - 1e-9);
        }
}

TEST(Fillet, BorderAlongTheEdgeIsARefusal) {
    EXPECT_THROW(fillet(checks::two_halves(), {{}, {}, {{0, 1, 0}}}, 1.2), Error);
}

TEST(Fillet, RadiusMustBeALength) {
    const Mesh mesh = checks::grid(2, 2, 2);
    for (const double radius : {0.0, -1.0, std::nan("")})
        EXPECT_THROW(fillet(mesh, {{}, {}, {{1, 0, 0}}}, radius), ToolError);
}

}  // namespace
}  // namespace femscalpel
