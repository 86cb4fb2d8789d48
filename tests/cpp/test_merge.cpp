// SPDX-License-Identifier: LGPL-2.1-or-later
// Two meshes as one: their lines, what is covered, refilled and united.
#include "operators/merge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/covered_faces.h"
#include "cutting/meeting.h"
#include "cutting/refill.h"
#include "deck/edge_beams.h"
#include "mesh/quality.h"
#include "operators/attach_along.h"
#include "operators/joint.h"
#include "operators/merge_refining.h"
#include "operators/seam.h"
#include "operators/simplify_at_meeting.h"
#include "operators/trim.h"
#include "operators/unite.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

Mesh moved(Mesh mesh, const Vec3& by) {
    for (Vec3& x : mesh.points) x += by;
    return mesh;
}

double volume(const Mesh& mesh) {
    double sum = 0;
    const CellBlock& b = mesh.block(CellType::tetra);
    for (Index c = 0; c < b.size(); ++c) {
        const auto n = b.nodes(c);
        const double v = signed_volume(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]);
        EXPECT_GT(v, 0);
        sum += v;
    }
    return sum;
}

TEST(Unite, NumbersFollowAndSharedNodesAreInGroupsOfBoth) {
    Mesh mesh = checks::grid(1, 1, 1);
    Mesh other = moved(checks::grid(1, 1, 1), {0, 0, 1});
    const FamilyIndex mine = checks::family_of(mesh, "A", GroupKind::node),
                      others = checks::family_of(other, "B", GroupKind::node);
    std::vector<Index> shared(8, -1);
    for (Index n = 0; n < 8; ++n)
        if (other.points[n][2] == 1) {
            shared[n] = checks::number_near(mesh, other.points[n]);
            mesh.node_families[shared[n]] = mine;
            other.node_families[n] = others;
        }
    mesh.add_group("NEW", GroupKind::element);
    const Index last = mesh.largest_cell_id();
    unite(mesh, other, shared, "NEW", {"X_", true});
    mesh.validate();
    EXPECT_EQ(mesh.node_count(), 12);
    EXPECT_EQ(mesh.block(CellType::tetra).size(), 12);
    EXPECT_NEAR(volume(mesh), 2, 1e-12);
    EXPECT_EQ(checks::members(mesh, "A", GroupKind::node), checks::members(mesh, "B", GroupKind::node));
    const std::vector<Index> added = checks::members(mesh, "NEW", GroupKind::element);
    EXPECT_EQ(added.size(), 6u);
    EXPECT_GT(*std::ranges::min_element(added), last);
}

TEST(Unite, GroupsOfOneNameJoinOrGetThePrefix) {
    const auto with_group = [] {
        Mesh mesh = checks::grid(1, 1, 1);
        mesh.block(CellType::tetra).families[0] = checks::family_of(mesh, "SAME", GroupKind::element);
        return mesh;
    };
    const std::vector<Index> none(8, -1);
    Mesh joined = with_group(), apart = with_group();
    unite(joined, moved(with_group(), {5, 0, 0}), none, "", {"X_", true});
    EXPECT_EQ(checks::members(joined, "SAME", GroupKind::element).size(), 2u);
    unite(apart, moved(with_group(), {5, 0, 0}), none, "", {"X_", false});
    EXPECT_EQ(checks::members(apart, "SAME", GroupKind::element).size(), 1u);
    EXPECT_EQ(checks::members(apart, "X_SAME", GroupKind::element).size(), 1u);
    EXPECT_THROW(unite(apart, with_group(), none, "", {"", false}), ToolError);
}

/// A cube on a block, whose nodes are the block's.
struct CubeOnBlock {
    Mesh block = checks::grid(3, 3, 1), cube = moved(checks::grid(1, 1, 1), {1, 1, 1});
    std::vector<std::array<Index, 2>> outline(const Mesh& mesh) const {
        const Vec3 corner[] = {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}};
        std::vector<std::array<Index, 2>> out;
        for (int k = 0; k < 4; ++k)
            out.push_back({checks::number_near(mesh, corner[k]), checks::number_near(mesh, corner[(k + 1) % 4])});
        return out;
    }
};

TEST(CoveredFaces, AreThoseInsideTheOutline) {
    const CubeOnBlock both;
    const auto on_block = covered_faces(both.block, both.cube, both.outline(both.block), 1e-9, false);
    EXPECT_EQ(on_block.size(), 2u);
    for (const SurfaceFace& f : on_block)
        for (const Index n : f.nodes) EXPECT_DOUBLE_EQ(both.block.points[n][2], 1);
    EXPECT_EQ(covered_faces(both.cube, both.block, both.outline(both.cube), 1e-9, true).size(), 2u);
    EXPECT_TRUE(covered_faces(both.block, moved(both.cube, {0, 0, 0.5}), both.outline(both.block), 1e-9, true).empty());
}

TEST(Refill, FitsASolidToTheSkinOfAnother) {
    const CubeOnBlock both;
    // A taller one, of which the top stays as it is.
    Mesh tower = checks::grid(1, 1, 4);
    for (Vec3& x : tower.points) x += Vec3(1, 1, 1);
    std::vector<Index> partner(tower.points.size(), -1);
    for (Index n = 0; n < tower.node_count(); ++n)
        if (tower.points[n][2] == 1) partner[n] = checks::number_near(both.block, tower.points[n]);
    const Refilled out =
        refill(tower, both.block, partner, covered_faces(tower, both.block, both.outline(tower), 1e-9, true),
               covered_faces(both.block, tower, both.outline(both.block), 1e-9, true));
    out.mesh.validate();
    EXPECT_GT(out.taken, 0);
    EXPECT_LT(out.taken, 24);
    EXPECT_GT(out.worst, 0.2);
    EXPECT_NEAR(volume(out.mesh), 4, 1e-12);
    EXPECT_EQ(std::ranges::count_if(out.partner, [](Index n) { return n >= 0; }), 4);
    // The elements of the top keep their numbers.
    const auto& ids = out.mesh.block(CellType::tetra).ids;
    for (Index c = 18; c < 24; ++c) EXPECT_NE(std::ranges::find(ids, tower.block(CellType::tetra).ids[c]), ids.end());
}

TEST(Seam, IsEdgesOfTheResult) {
    const Mesh mesh = checks::grid(4, 4, 1);
    const Ribbon ribbon({{0.6, 0.7, 1}, {3.3, 2.9, 1}}, {2, Vec3::UnitZ()}, false);
    ImprintLine line{&ribbon, {0, ribbon.length()}, {{0.6, 0.7, 1}, {3.3, 2.9, 1}}, {-1, -1}};
    OperatorOptions options;
    options.name = "X";
    const Seamed seamed = imprint_seam(mesh, {line}, false, options, {});
    ASSERT_EQ(seamed.lines.size(), 1u);
    ASSERT_EQ(seamed.lines[0].at_stop.size(), 2u);
    for (const Index n : seamed.lines[0].nodes) EXPECT_NEAR(ribbon.distance(seamed.result.mesh.points[n]), 0, 1e-9);
    EXPECT_NEAR(volume(seamed.result.mesh), 16, 1e-12);
    EXPECT_TRUE(seamed.result.mesh.groups.empty());
}

TEST(Joint, NodesThatCannotBeBroughtTogetherAreNoFaultOfTheMesh) {
    Mesh floor, wall;
    checks::add_plate(floor, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4, 4);
    checks::add_plate(wall, {0, 2, 0}, {1, 0, 0}, {0, 0, 1}, 4, 1);
    MeetingLine line;
    for (const double x : {0.0, 4.0})
        line.points.push_back({{x, 2, 0},
                               {Vec3(0, 0, 1), Vec3(0, 1, 0)},
                               {checks::number_near(floor, {x, 2, 0}), checks::number_near(wall, {x, 2, 0})},
                               {1, 1}});
    std::vector<JointLine> lines;
    lines.push_back(line_of(line, floor));
    // A node that would have to pass over its neighbours.
    lines.front().stops.front().node[0] = checks::number_near(floor, {1, 1, 0});
    OperatorOptions options;
    options.name = "JOINT";
    Joint joint(floor, wall, std::move(lines), options);
    try {
        joint.run({});
        FAIL() << "joined";
    } catch (const QualityError& error) {
        EXPECT_STREQ(error.parameter(), "other");
        EXPECT_THAT(error.what(), testing::StartsWith("nodes of the two near ("));
    }
}

TEST(Joint, StopsAreAtEndsBendsAndNodes) {
    MeetingLine line;
    const std::array<Vec3, 2> normals{Vec3::UnitZ(), Vec3::UnitY()};
    const auto add = [&](double x, double y, Index mine, Index others) {
        line.points.push_back({Vec3(x, y, 0), normals, {mine, others}, {1, 1}});
    };
    add(0, 0, -1, 3);     // an end
    add(1, 0, -1, -1);    // a crossing of edges
    add(2, 0, 4, -1);     // a node of the mesh
    add(2.1, 0, -1, 5);   // of the addition, near it
    add(3, 0, -1, -1);    // a bend
    add(4, 0.3, -1, -1);  // an end
    Mesh mesh;
    for (int k = 0; k < 5; ++k) mesh.add_node({k == 4 ? 2.0 : 9.0, 0, 0}, k + 1);
    const JointLine joint = line_of(line, mesh);
    ASSERT_EQ(joint.stops.size(), 4u);
    EXPECT_EQ(joint.stops[1].node, (std::array<Index, 2>{4, 5}));
    EXPECT_EQ(joint.stops[1].at, Vec3(2, 0, 0));
    EXPECT_EQ(joint.stops[2].node, (std::array<Index, 2>{-1, -1}));
    EXPECT_NEAR(ribbon_of(line, 0)->length(), 3 + std::hypot(1, 0.3), 1e-12);
}

TEST(SimplifyAtMeeting, DividesWhatIsNearAndNothingElse) {
    const Mesh base = checks::bricks(12, 10, 6), part = moved(checks::bricks(2, 2, 2), {5.2, 4.3, 6});
    const Meeting meeting = find_meeting(base, part, {});
    ASSERT_EQ(meeting.lines.size(), 4u);  // the four sides
    const auto converted = simplify_at_meeting(base, part, meeting.lines, false, {}, {});
    ASSERT_TRUE(converted);
    const Index left = converted->mesh.block(CellType::hexahedron).size();
    EXPECT_LT(left, 12 * 10 * 6 - 9);
    EXPECT_GE(left, 120);  // the lowest layer
    EXPECT_GT(converted->mesh.block(CellType::pyramid).size(), 0);
    const auto again = simplify_at_meeting(converted->mesh, part, meeting.lines, false, {}, {});
    EXPECT_FALSE(again);
    EXPECT_FALSE(simplify_at_meeting(checks::grid(3, 3, 3), part, meeting.lines, true, {}, {}));
    // What gives way is divided inside of the other, too.
    const auto within = simplify_at_meeting(moved(checks::bricks(12, 10, 12), {0, 0, -9}), base, {}, true, {}, {});
    ASSERT_TRUE(within);
    EXPECT_GE(within->report.converted.at("hexahedron"), 3 * 120);
    EXPECT_LE(within->report.converted.at("hexahedron"), 7 * 120);
}

TEST(MergeRefining, DividesWhatItRefines) {
    const Mesh base = checks::bricks(6, 6, 4);
    Mesh part = checks::grid(3, 3, 3);
    for (Vec3& x : part.points) x = 0.2 * x + Vec3(2.7, 2.6, 4);
    const Meeting meeting = find_meeting(base, part, {});
    MergeRefining refining(base, part, {});
    refining.run(meeting.lines, 2.5, 20, {});
    EXPECT_TRUE(refining.any());
    EXPECT_EQ(&refining.mesh(1), &part);
    Report report;
    refining.join(0, report);
    ASSERT_TRUE(report.refinement);
    EXPECT_GT(report.converted.at("hexahedron"), 0);
    EXPECT_GT(refining.mesh(0).block(CellType::tetra).size(), 0);
}

TEST(MergeRefining, DividesNoFurtherThanItIsTo) {
    const Mesh base = checks::grid(12, 12, 8);
    Mesh part = checks::grid(40, 1, 1);
    for (Vec3& x : part.points) x = 0.02 * x + Vec3(5.7, 5.6, 8);
    const Meeting meeting = find_meeting(base, part, {});
    MergeRefining refining(base, part, {});
    try {
        refining.run(meeting.lines, 0.01, 1, {});
        ADD_FAILURE() << "no error";
    } catch (const ToolError& error) {
        EXPECT_STREQ(error.parameter(), "refine");
        EXPECT_THAT(error.what(), testing::HasSubstr("the addition is so much finer than the mesh"));
        EXPECT_THAT(error.what(), testing::HasSubstr("Give refine="));
    }
    OperatorOptions options;
    options.refine.when = RefineFirst::When::never;
    MergeRefining none(base, part, options);
    none.run(meeting.lines, 0.01, 1, {});
    EXPECT_FALSE(none.any());
    options.refine = {RefineFirst::When::to_size, 0.3};
    MergeRefining sized(base, part, options);
    sized.run(meeting.lines, 0.01, 1, {});
    Report report;
    sized.join(0, report);
    ASSERT_TRUE(report.refinement);
    EXPECT_EQ(report.refinement->size, 0.3);
}

TEST(AttachAlong, BeamsBecomeEdges) {
    Mesh floor;
    checks::add_plate(floor, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 6, 6);
    Mesh beams;
    for (const double x : {0.5, 2.7, 5.5}) beams.add_node({x, 1.3 + x / 2, 0}, beams.node_count() + 1, 0);
    beams.add_cell(CellType::line, std::array<Index, 2>{0, 1}, 1, 0);
    beams.add_cell(CellType::line, std::array<Index, 2>{1, 2}, 2, 0);
    std::vector<std::string> bowed;
    MergeOptions options;
    options.name = "ADD";
    const auto along = attach_along(floor, beams, options, {}, bowed);
    ASSERT_TRUE(along);
    EXPECT_TRUE(bowed.empty());
    EXPECT_EQ(along->on_solids, 0);
    EXPECT_GT(along->addition.block(CellType::line).size(), 5);
    EXPECT_THAT(along->shared, testing::Each(testing::Ge(0)));
    for (Vec3& x : beams.points) x.z() = 1;
    EXPECT_FALSE(attach_along(floor, beams, options, {}, bowed));
}

TEST(EdgeBeams, AreSegmentsOfTheGroup) {
    Mesh mesh;
    for (const double x : {0., 1., 2.}) mesh.add_node({x, 0, 0}, mesh.node_count() + 1, 0);
    const GroupIndex group = mesh.add_group("BEAMS", GroupKind::element);
    mesh.add_cell(CellType::line, std::array<Index, 2>{0, 1}, 1, mesh.families.with(0, group));
    mesh.add_cell(CellType::line, std::array<Index, 2>{1, 2}, 2, 0);
    mark_edge_beams(mesh, group);
    const auto hidden = mesh.find_group(edge_beams_group, GroupKind::element, true);
    ASSERT_TRUE(hidden);
    EXPECT_TRUE(mesh.families.contains(mesh.block(CellType::line).families[0], *hidden));
    EXPECT_FALSE(mesh.families.contains(mesh.block(CellType::line).families[1], *hidden));
    mark_edge_beams(mesh, group);
    EXPECT_EQ(mesh.groups.size(), 2U);
}

TEST(Trim, LeavesWhatIsOnThePointsSide) {
    // Four squares, two on each side of the line x = 0, the second mesh of a joint.
    Mesh shell;
    checks::add_plate(shell, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
    JointLine line;
    const std::vector<Vec3> points{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
    line.standing[0] = std::make_unique<Ribbon>(points, std::vector<Vec3>(3, Vec3::UnitX()), false);
    for (const Vec3& x : points) line.stops.push_back({x, {-1, checks::number_near(shell, x)}});
    const std::array<JointLine, 1> lines{std::move(line)};
    for (const double side : {1.0, -1.0}) {
        const Crop kept = trimmed(shell, lines, {5 * side, 1, 1});
        EXPECT_EQ(kept.mesh.block(CellType::triangle).size(), 4);
        for (const Vec3& x : kept.mesh.points) EXPECT_GE(x[0] * side, 0);
    }
}

TEST(Merge, ATowerOnABlock) {
    MergeOptions options;
    options.name = "TOWER";
    const Result out = merge(checks::grid(4, 4, 1), moved(checks::grid(1, 1, 2), {1.3, 1.4, 1}), options);
    out.mesh.validate();
    EXPECT_NEAR(volume(out.mesh), 18, 1e-12);
    EXPECT_GE(checks::members(out.mesh, "TOWER_SEAM", GroupKind::node).size(), 4u);
    EXPECT_GT(out.report.quality_after.minimum, 0.2);
}

TEST(Merge, WhatIsApartIsAnError) {
    MergeOptions options;
    options.name = "TOWER";
    EXPECT_THROW(merge(checks::grid(2, 2, 1), moved(checks::grid(1, 1, 1), {9, 9, 9}), options), ToolError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
