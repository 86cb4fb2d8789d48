// SPDX-License-Identifier: LGPL-2.1-or-later
// The report of a cut made by hand: a bar of cubes opened at a plane that nodes are moved onto.
#include "operators/account.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/snap.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::HasSubstr;
using testing::IsEmpty;

struct AccountTest : testing::Test {
    Report opened_at(const Mesh& mesh, const Refined* refined = nullptr) {
        options.name = "TEST";
        Edit edit(mesh, {});
        edit.start_copy();
        const std::vector<bool> drifting = drifting_groups(mesh, options.preserve);
        Account account("opening", options, edit, refined, drifting);
        ConstraintOptions constraints;
        constraints.drifting_groups = drifting;
        Workpiece f = checks::whole_workpiece(mesh, plane);
        f.d = Deformable(extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0)), mesh, constraints);
        const Blade blade{.tool = &plane, .bound = {}, .inside = {}};
        account.open(f);
        cut_along(f, blade);
        const Opening opening = open_lips(f);
        account.judge(f, {&blade, 1}, opening);
        const Naming naming{.groups = {{"TEST_N"}, {"TEST_P"}}, .front = ""};
        Laps laps;
        Stopwatch watch(laps);
        const Edited edited = edit.finish(f, opening, naming, watch);
        return account.close(f, {&blade, 1}, opening, naming, edited);
    }
    static const GroupRecord& record(const Report& report, const char* name) {
        return *std::ranges::find(report.groups, name, &GroupRecord::name);
    }
    Plane plane{{1.8, 0, 0}, {1, 0, 0}};
    OperatorOptions options;
};

TEST_F(AccountTest, CountsWhatWasDone) {
    const Report report = opened_at(checks::grid(4, 2, 2));
    EXPECT_EQ(report.operation, "opening");
    EXPECT_EQ(report.name, "TEST");
    EXPECT_EQ(report.method, "snap");
    EXPECT_EQ(report.transition, 2);
    EXPECT_EQ(report.nodes_moved, 9);
    EXPECT_NEAR(report.max_displacement, 0.2, 1e-14);
    EXPECT_EQ(report.nodes_doubled, 9);
    EXPECT_EQ(report.nodes_split, 0);
    EXPECT_EQ(report.nodes_added, 9);
    EXPECT_EQ(report.nodes_removed, 0);
    EXPECT_EQ(report.elements_added, 16);
    EXPECT_EQ(report.elements_removed, 0);
    // Of nine nodes in x = 2 one is inside; so are one in x = 1 and one in x = 3.
    EXPECT_EQ(report.node_sets.at("ICN").size(), 1u);
    EXPECT_EQ(report.node_sets.at("ECN").size(), 8u);
    EXPECT_EQ(report.node_sets.at("ITN").size(), 2u);
    EXPECT_EQ(report.node_sets.at("ETN").size(), 34u);
    EXPECT_EQ(report.constraints.at("plane"), 9);
    EXPECT_EQ(report.constraints.at("tangent plane"), 8 + 34);
    EXPECT_EQ(report.constraints.at("fixed"), 8) << "the corners of the bar";
    EXPECT_EQ(report.constraints.at("line"), 4 * 3 + 8) << "on its long edges, and between corners of its ends";
    EXPECT_EQ(report.constraints.at("free"), 2) << "on no tool either";
    EXPECT_EQ(report.quality_before.count, 96);
    EXPECT_EQ(report.quality_after.count, 96);
    EXPECT_LT(report.quality_after.minimum, report.quality_before.minimum);
    EXPECT_EQ(record(report, "TEST_N").status, "new");
    EXPECT_EQ(record(report, "TEST_N").count_after, 8);
    EXPECT_NEAR(record(report, "TEST_P").measure_after, 4, 1e-14);
    EXPECT_THAT(report.warnings, IsEmpty());
    EXPECT_TRUE(report.poor.empty());
    EXPECT_EQ(report.held.count, 0);
}

TEST_F(AccountTest, DescribesGroups) {
    Mesh mesh = checks::grid(4, 2, 2);
    const FamilyIndex near = checks::family_of(mesh, "NEAR", GroupKind::node),
                      far = checks::family_of(mesh, "FAR", GroupKind::node),
                      all = checks::family_of(mesh, "ALL", GroupKind::element);
    mesh.node_families[checks::number_near(mesh, {2, 0, 1})] = near;
    mesh.node_families[checks::number_near(mesh, {2, 0, 2})] = near;
    mesh.node_families[checks::number_near(mesh, {4, 0, 0})] = far;
    for (FamilyIndex& f : mesh.block(CellType::tetra).families) f = all;
    options.preserve = {"ALL", "FAR"};
    const Report report = opened_at(mesh);
    EXPECT_EQ(record(report, "NEAR").nodes_moved, 2);
    EXPECT_FALSE(record(report, "NEAR").boundary_kept);
    EXPECT_NEAR(record(report, "NEAR").boundary_drift, 0.2, 1e-12);
    EXPECT_EQ(record(report, "NEAR").count_after, 4) << "with their copies";
    EXPECT_EQ(record(report, "FAR").status, "untouched");
    EXPECT_TRUE(record(report, "FAR").boundary_kept);
    EXPECT_EQ(record(report, "FAR").nodes_fixed, 1);
    EXPECT_EQ(record(report, "ALL").status, "kept");
    EXPECT_EQ(record(report, "ALL").nodes_moved, 9);
    EXPECT_NEAR(record(report, "ALL").measure_after, 16, 1e-12);
    EXPECT_LT(record(report, "ALL").boundary_drift, 1e-12);
}

TEST_F(AccountTest, GoesOnFromARefinement) {
    Refined refined;
    refined.report.warnings = {"it was coarse"};
    refined.tried_in_vain = true;
    const Report vain = opened_at(checks::grid(4, 2, 2), &refined);
    EXPECT_THAT(vain.warnings, testing::ElementsAre("it was coarse"));
    EXPECT_FALSE(vain.refinement);
    EXPECT_EQ(vain.nodes_moved, 9);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
