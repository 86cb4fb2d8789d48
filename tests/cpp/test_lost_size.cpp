// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "mesh/quality.h"
#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/plane.h"
#include "tools/sphere.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const auto says_lost = Contains(HasSubstr("a curved surface is coarse"));

/// The box from 0 to n bent to a rod about the z-axis (its square section made round) or a ball: a skin of few flat
/// facets.
Mesh rounded(int n, int height, bool ball) {
    Mesh mesh = checks::grid(n, n, height);
    const Vec3 half(n / 2.0, n / 2.0, height / 2.0);
    for (Vec3& x : mesh.points) {
        Vec3 y = x - half;
        Vec3 flat = y;
        if (!ball) flat.z() = 0;
        const double most = flat.cwiseAbs().maxCoeff(), length = flat.norm();
        if (length > 0) y += flat * (most / length - 1);
        x = y;
    }
    return mesh;
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (Index c = 0; c < mesh.block(CellType::tetra).size(); ++c) sum += cell_measure(mesh, CellType::tetra, c);
    return sum;
}

/// With the corners between the facets of the skin no feature lines.
template <class Options>
Options smooth() {
    Options o;
    o.feature_angle = 100;
    o.refine.when = RefineFirst::When::never;
    return o;
}

TEST(LostSizeTest, CracksThroughACoarseBallAreToldWhatTheyCost) {
    const Mesh mesh = rounded(4, 4, true);
    const Result r = crack(mesh, Plane({0.3, 0.2, 0.1}, {1, 0.4, 0.3}), smooth<CrackOptions>());
    ASSERT_GT(std::abs(volume(r.mesh) / volume(mesh) - 1), 0.005) << "nothing is lost: the test says nothing";
    EXPECT_THAT(r.report.warnings, says_lost);
}

TEST(LostSizeTest, SlotsThroughACoarseBall) {
    const Mesh mesh = rounded(4, 4, true);
    const Result r = cut(mesh, Plane({0.3, 0.2, 0.1}, {1, 0.4, 0.3}), 0.5, smooth<CutOptions>());
    EXPECT_THAT(r.report.warnings, says_lost);
    EXPECT_THAT(r.report.warnings, Contains(HasSubstr("beyond what was removed")));
}

TEST(LostSizeTest, HolesThroughACoarseRod) {
    const Mesh mesh = rounded(6, 8, false);
    const Cylinder hole({0.1, 0, 0.2}, {1, 0.1, 0.2}, 1.7);
    const Tool* tool = &hole;
    const Result r = drill(mesh, {&tool, 1}, smooth<DrillOptions>());
    EXPECT_THAT(r.report.warnings, says_lost);
}

TEST(LostSizeTest, NothingIsLostWhereTheSkinIsFlat) {
    Mesh mesh = checks::grid(6, 6, 4);
    const FamilyIndex left = checks::family_of(mesh, "LEFT", GroupKind::element);
    CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c)
        if (mesh.points[tetras.nodes(c)[0]].x() < 3) tetras.families[c] = left;
    const Cylinder hole({2.7, 3.1, 0}, {0, 0, 1}, 1.6), slanting({2.7, 3.1, 0}, {0.2, 0.1, 1}, 1.2);
    const Sphere bubble({3.2, 2.9, 4}, 1.7);
    const Tool* tools[] = {&hole, &slanting, &bubble};
    for (const Tool*& tool : tools) {
        auto options = smooth<DrillOptions>();
        options.feature_angle = 30;
        const Result r = drill(mesh, {&tool, 1}, options);
        EXPECT_THAT(r.report.warnings, Not(says_lost)) << tool->kind() << " " << r.report.warnings.front();
    }
    // Holes that overlap, and a blind one.
    const Cylinder second({4.1, 3.1, 0}, {0, 0, 1}, 1.2);
    const Tool* both[] = {&hole, &second};
    EXPECT_THAT(drill(mesh, both).report.warnings, Not(says_lost));
    DrillOptions blind;
    blind.depth = 2.3;
    EXPECT_THAT(drill(mesh, {tools, 1}, blind).report.warnings, Not(says_lost));
    EXPECT_THAT(cut(mesh, Plane({3.3, 3, 2}, {1, 0.3, 0.2}), 1.4).report.warnings, Not(says_lost));
    EXPECT_THAT(crack(mesh, Plane({3.3, 3, 2}, {1, 0.3, 0.2})).report.warnings, Not(says_lost));
    CrackOptions drifting;
    drifting.preserve.emplace();
    EXPECT_THAT(crack(mesh, Plane({3.3, 3, 2}, {1, 0.03, 0.02}), drifting).report.warnings, Not(says_lost))
        << "a drifting border hands over, nothing is lost";
}

TEST(LostSizeTest, SecondOrderAndShells) {
    const Mesh curved = checks::second_order(checks::grid(5, 5, 3));
    const Cylinder hole({2.4, 2.6, 0}, {0, 0, 1}, 1.4);
    const Tool* tool = &hole;
    DrillOptions options;
    options.refine.when = RefineFirst::When::never;
    EXPECT_THAT(drill(curved, {&tool, 1}, options).report.warnings, Not(says_lost));
    Mesh plate;
    checks::add_plate(plate, Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), 6, 6);
    EXPECT_THAT(drill(plate, {&tool, 1}, options).report.warnings, Not(says_lost));
    // The same plate rolled up to a coarse tube.
    for (Vec3& x : plate.points) {
        const double angle = std::numbers::pi / 3 * x.x();
        x = Vec3(2 * std::cos(angle), 2 * std::sin(angle), x.y());
    }
    EXPECT_THAT(crack(plate, Plane({0.4, 0.9, 3.2}, {0.2, 1, 0.3}), smooth<CrackOptions>()).report.warnings, says_lost);
    EXPECT_THAT(cut(plate, Plane({0.4, 0.9, 3.2}, {0.2, 1, 0.3}), 0.6, smooth<CutOptions>()).report.warnings,
                says_lost);
}

TEST(LostSizeTest, GroupsAreNamedAndDriftingOnesAreNot) {
    Mesh mesh = rounded(4, 4, true);
    const FamilyIndex shell = checks::family_of(mesh, "OUTER", GroupKind::element);
    CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c) {
        Vec3 middle = Vec3::Zero();
        for (const Index n : tetras.nodes(c)) middle += mesh.points[n] / 4;
        if (middle.norm() > 1.2) tetras.families[c] = shell;
    }
    const Plane plane({0.3, 0.2, 0.1}, {1, 0.4, 0.3});
    auto options = smooth<CrackOptions>();
    EXPECT_THAT(crack(mesh, plane, options).report.warnings, Contains(HasSubstr("'OUTER' by")));
    options.preserve.emplace();
    const auto warnings = crack(mesh, plane, options).report.warnings;
    EXPECT_THAT(warnings, says_lost) << "the mesh as a whole loses, whatever borders inside do";
    EXPECT_THAT(warnings, Not(Contains(HasSubstr("'OUTER' by"))));
}

/// The mesh with the triangles of its skin at its lowest z as the group END.
Mesh with_end(Mesh mesh) {
    const FamilyIndex end = checks::family_of(mesh, "END", GroupKind::element);
    CellBlock& triangles = mesh.block(CellType::triangle);
    const CellBlock& tetras = mesh.block(CellType::tetra);
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3& x : mesh.points) low = std::min(low, x.z());
    Index id = *std::ranges::max_element(tetras.ids);
    for (Index c = 0; c < tetras.size(); ++c)
        for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
            std::array<Index, 3> nodes;
            for (int k = 0; k < 3; ++k) nodes[k] = tetras.connectivity[static_cast<std::size_t>(4 * c + face[k])];
            if (!std::ranges::all_of(nodes, [&](Index n) { return mesh.points[n].z() < low + 1e-9; })) continue;
            triangles.connectivity.insert(triangles.connectivity.end(), nodes.begin(), nodes.end());
            triangles.ids.push_back(++id);
            triangles.families.push_back(end);
        }
    return mesh;
}

const GroupRecord& record_of(const Result& r, const char* name) {
    return *std::ranges::find(r.report.groups, name, &GroupRecord::name);
}

TEST(LostSizeTest, AreasOfGroupsOfFacesAreLookedAt) {
    // The rod's flat end as a group of triangles: a plane along the rod moves nodes of its round border.
    const Mesh mesh = with_end(rounded(4, 2, false));
    const auto says_so = Contains(AllOf(HasSubstr("a curved surface is coarse"), HasSubstr("'END' by")));
    const Plane plane({0.1, 0.35, 0}, {1, 0.8, 0.02});
    const Result r = crack(mesh, plane, smooth<CrackOptions>());
    ASSERT_LT(record_of(r, "END").measure_after, 0.995 * record_of(r, "END").measure_before)
        << "nothing is lost: the test says nothing";
    EXPECT_THAT(r.report.warnings, says_so);
    const Result slot = cut(mesh, plane, 0.1, smooth<CutOptions>());
    EXPECT_THAT(slot.report.warnings, says_so) << "what the slot takes is not what is lost";
}

TEST(LostSizeTest, WhatAToolTakesOfFacesIsNotLost) {
    const Mesh mesh = with_end(checks::grid(6, 6, 3));
    const Cylinder hole({2.7, 3.1, 0}, {0, 0, 1}, 1.6), slanting({2.7, 3.1, 0}, {0.2, 0.1, 1}, 1.2);
    for (const Tool* tool : {&hole, &slanting}) {
        const Result r = drill(mesh, {&tool, 1}, smooth<DrillOptions>());
        ASSERT_LT(record_of(r, "END").measure_after, 0.9 * record_of(r, "END").measure_before);
        EXPECT_THAT(r.report.warnings, Not(says_lost));
    }
    EXPECT_THAT(cut(mesh, Plane({3.3, 3, 2}, {1, 0.3, 0.2}), 1.4).report.warnings, Not(says_lost));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
