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

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
