// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cutting/inner_node.h"
#include "mesh/quality.h"
#include "operators/fillet_cavity.h"
#include "operators/fillet_corner.h"
#include "operators/fillet_inside.h"
#include "operators/fillet_material.h"
#include "operators/fillet_patch.h"
#include "operators/fillet_run.h"
#include "simple_meshes.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

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

TEST(Fillet, ElementsBetweenTheWalls) {
    const Mesh mesh = checks::grid(4, 4, 4);
    const FilletPath path(mesh, find_feature_lines(mesh, {{}, {}, {{2, 0, 0}}}, 30).at(0), 2, skin_of(mesh));
    const Workpiece f = checks::whole_workpiece(mesh, checks::away);
    const auto in = [&](double reach) {
        double sum = 0;
        for (const int t : elements_inside(f, f.d.band.tetras, path, reach, 0.1)) {
            const Vec3 middle = middle_of(f.d.band, f.d.band.tetras[t]);
            EXPECT_TRUE(middle.y() < 2 && middle.z() < 2);
            sum += 1;
        }
        return sum;
    };
    EXPECT_EQ(in(4), 4 * 2 * 2 * 6) << "six elements in each of the cubes along the edge";
    Workpiece apart = checks::whole_workpiece(mesh, checks::away);
    for (int v = 0; v < apart.d.band.size(); ++v) apart.d.band.nodes[v].at += Vec3(0, 3, 3);
    EXPECT_TRUE(elements_inside(apart, apart.d.band.tetras, path, 4, 0.1).empty());
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

TEST(Fillet, SecondOrderEdgeHasMidSideNodesOnTheCylinder) {
    const Mesh mesh = checks::second_order(checks::grid(4, 4, 4));
    const Result result = fillet(mesh, {{}, {}, {{2, 0, 0}}}, 1.5);
    const double removed = (1 - M_PI / 4) * 1.5 * 1.5 * 4;
    EXPECT_NEAR(64 - volume(result.mesh), removed, 0.001 * removed);
    const CellBlock& face = result.mesh.block(CellType::triangle6);
    EXPECT_GT(face.size(), 0);
    for (Index c = 0; c < face.size(); ++c)
        for (const Index n : face.nodes(c)) {
            const Vec3& x = result.mesh.points[n];
            EXPECT_NEAR(std::hypot(x.y() - 1.5, x.z() - 1.5), 1.5, 1e-9);
        }
}

TEST(Fillet, NewNodesJoinTheGroupsOfFacesAcrossTheEdge) {
    Mesh mesh = checks::grid(4, 4, 4);
    const FamilyIndex end = checks::family_of(mesh, "END", GroupKind::node);
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (mesh.points[n].x() == 0) mesh.node_families[n] = end;
    const Result result = fillet(mesh, {{}, {}, {{2, 0, 0}}}, 1.5);
    const auto group = *result.mesh.find_group("END", GroupKind::node);
    for (Index n = 0; n < result.mesh.node_count(); ++n)
        EXPECT_EQ(result.mesh.families.contains(result.mesh.node_families[n], group), result.mesh.points[n].x() == 0);
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

TEST(Fillet, MaterialThatGoesFallsIntoDomains) {
    const Mesh mesh = checks::two_halves();
    const FilletPath path(mesh, find_feature_lines(mesh, {{}, {}, {{1, 0, 0}}}, 30).at(0), 1, skin_of(mesh));
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    const std::array edges{FilletReach{&path, 1.5}};
    FilletMaterial material(f, mesh, edges);
    EXPECT_EQ(material.domains(), 2);
    EXPECT_EQ(material.removed().size(), 2U * 6U);
    EXPECT_EQ(material.borders.size(), 2U) << "the square between them";
    EXPECT_EQ(material.strip(0, 0).size(), 4U);
    FilletPatches patches(material);
    FilletRun run(material, patches, path, 0);
    run.find_sections();
    ASSERT_EQ(run.sections().size(), 3U) << "both ends and the border";
    EXPECT_TRUE(material.borders.empty());
    ASSERT_EQ(patches.all().size(), 3U);
    for (const FilletPatch& patch : patches.all()) EXPECT_EQ(patch.old.size(), 2U) << "a square";
    run.find_rows();
    EXPECT_EQ(run.row(0).size(), 3U);
    EXPECT_NEAR(run.sections()[1].s, 1, 1e-12);
}

TEST(Fillet, BorderBesideAConvexEdgeIsARefusal) {
    EXPECT_THROW(fillet(checks::two_halves(), {{}, {}, {{0, 1, 0}}}, 1.2), Error);
}

TEST(Fillet, CornersOfAPlaneMesh) {
    for (const bool second_order : {false, true}) {
        Mesh mesh;
        checks::add_plate(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 6, 4);
        if (second_order) mesh = checks::second_order(mesh);
        const Result result = fillet(mesh, {{}, {}, {{6, 4, 0}, {0, 0, 0}}}, 1.5);
        result.mesh.validate();
        double area = 0;
        for (const CellType type : {CellType::triangle, CellType::triangle6})
            for (Index c = 0; c < result.mesh.block(type).size(); ++c) area += cell_measure(result.mesh, type, c);
        const double removed = 2 * (1 - M_PI / 4) * 1.5 * 1.5;
        EXPECT_NEAR(24 - area, removed, (second_order ? 0.001 : 0.03) * removed);
        const CellBlock& arc = result.mesh.block(second_order ? CellType::line3 : CellType::line);
        EXPECT_GE(arc.size(), 16);
        for (Index c = 0; c < arc.size(); ++c)
            for (const Index n : arc.nodes(c)) {
                const Vec3& x = result.mesh.points[n];
                const double off = std::min(std::abs((x - Vec3(1.5, 1.5, 0)).norm() - 1.5),
                                            std::abs((x - Vec3(4.5, 2.5, 0)).norm() - 1.5));
                EXPECT_LT(off, 1e-9);
            }
    }
}

TEST(Fillet, CornersThatAreNone) {
    Mesh mesh;
    checks::add_plate(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 6, 4);
    const Index inside = mesh.node_ids[checks::number_near(mesh, {3, 2, 0})];
    EXPECT_THROW(fillet(mesh, {{}, {inside}, {}}, 1), ToolError);
    EXPECT_THROW(fillet(mesh, {{}, {}, {{0, 0, 0}}}, 4.2), ToolError) << "larger than the side";
    EXPECT_EQ(find_outline_corners(mesh, {{}, {}, {{0, 0, 0}}}, 30).at(0).convex, true);
}

TEST(Fillet, RadiusMustBeALength) {
    const Mesh mesh = checks::grid(2, 2, 2);
    for (const double radius : {0.0, -1.0, std::nan("")})
        EXPECT_THROW(fillet(mesh, {{}, {}, {{1, 0, 0}}}, radius), ToolError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
