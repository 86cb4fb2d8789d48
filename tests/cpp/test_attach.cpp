// SPDX-License-Identifier: LGPL-2.1-or-later
// Beams that end on a mesh.
#include "operators/attach.h"

#include <gtest/gtest.h>

#include "operators/merge_report.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

Mesh beam(const Vec3& from, const Vec3& to) {
    Mesh mesh;
    mesh.add_node(from, 1);
    mesh.add_node(to, 2);
    const Index nodes[] = {0, 1};
    mesh.add_cell(CellType::line, nodes, 1);
    return mesh;
}

MergeOptions named(const char* name) {
    MergeOptions options;
    options.name = name;
    return options;
}

TEST(AttachBeams, TakesANodeThatIsThere) {
    const Mesh mesh = checks::grid(3, 3, 1);
    const Result out = attach_beams(mesh, beam({1, 1, 1}, {1, 1, 3}), named("B"), {});
    out.mesh.validate();
    EXPECT_EQ(out.mesh.node_count(), mesh.node_count() + 1);
    EXPECT_EQ(out.mesh.points[out.mesh.block(CellType::line).nodes(0)[0]], Vec3(1, 1, 1));
    EXPECT_EQ(checks::members(out.mesh, "B_SEAM", GroupKind::node).size(), 1u);
    EXPECT_EQ(out.report.nodes_added, 1);
    EXPECT_THAT(out.report.warnings, testing::ElementsAre(testing::HasSubstr("no moment")));
}

TEST(AttachBeams, MakesANodeAndEndsThere) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4, 4);
    const Vec3 at(1.6, 2.3, 0);
    const Result out = merge(mesh, beam(at + Vec3(0, 0, 0.02), at + Vec3(0, 0, 2)), named("B"));
    out.mesh.validate();
    const Index foot = out.mesh.block(CellType::line).nodes(0)[0];
    EXPECT_NEAR((out.mesh.points[foot] - at).norm(), 0, 1e-12);
    const auto& triangles = out.mesh.block(CellType::triangle).connectivity;
    EXPECT_NE(std::ranges::find(triangles, foot), triangles.end());
    EXPECT_TRUE(out.report.warnings.empty());
}

TEST(AttachBeams, RefusesWhatDoesNotEndThere) {
    const Mesh mesh = checks::grid(3, 3, 2);
    EXPECT_THROW(attach_beams(mesh, beam({1, 1, 2.5}, {1, 1, 3}), named("B"), {}), ToolError);
    EXPECT_THROW(attach_beams(mesh, beam({1.5, 1.4, 1}, {1.5, 1.4, 3}), named("B"), {}), ToolError);
}

TEST(MergeReport, KeepsWhatIsKnownOfTheMesh) {
    Mesh mesh = checks::two_halves();
    Mesh result = mesh;
    GroupRecord known = merged_records(mesh, mesh, {}).front();
    known.status = "drifted";
    add_seam(result, "S", {0, 3});
    const auto records = merged_records(mesh, result, {known});
    EXPECT_EQ(records.front().status, "drifted");
    EXPECT_EQ(records.back().name, "S_SEAM");
    EXPECT_EQ(records.back().count_after, 2);
}

TEST(MergeReport, WhatOnlyALaterStepChangedIsNotUntouched) {
    const Mesh mesh = checks::two_halves();
    std::vector<GroupRecord> known = merged_records(mesh, mesh, {});
    ASSERT_GT(known.front().count_before, 0);
    known.front().status = "untouched";
    Mesh result = mesh;
    std::ranges::fill(result.node_families, 0);
    for (const CellBlock& b : mesh.blocks()) std::ranges::fill(result.block(b.type).families, 0);
    const auto records = merged_records(mesh, result, known);
    EXPECT_EQ(records.front().count_after, 0);
    EXPECT_NE(records.front().status, "untouched");
}

TEST(MergeReport, SaysTheWorstOfHowTheSeamRuns) {
    const std::string along = "the seam runs along a feature line or border line at ", wedge = " degrees: a wedge";
    const std::string near = "the seam runs within 0.15 edge lengths of a nearly parallel surface or group border at ";
    std::vector<std::string> warnings = {along + "3" + wedge,
                                         near + "2 nodes: thin",
                                         "other",
                                         along + "0.5" + wedge,
                                         near + "10 nodes: thin",
                                         "other",
                                         "the addition: " + along + "2" + wedge,
                                         near + "9 nodes: thin"};
    join_warnings_about_the_seam(warnings);
    EXPECT_EQ(warnings, (std::vector<std::string>{along + "0.5" + wedge, near + "10 nodes: thin", "other",
                                                  "the addition: " + along + "2" + wedge}));
    warnings.push_back(along + "less than 0.1" + wedge);
    join_warnings_about_the_seam(warnings);
    EXPECT_EQ(warnings[0], along + "less than 0.1" + wedge);
}

TEST(MergeReport, PoorPlacesOfBothStepsStay) {
    Report before, after;
    before.poor.resize(1);
    before.poor[0].mean_ratio = 0.01;
    after.poor.resize(2);
    EXPECT_EQ(joined(before, after).poor.size(), 3);
    EXPECT_EQ(joined(before, after).poor[0].mean_ratio, 0.01);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
