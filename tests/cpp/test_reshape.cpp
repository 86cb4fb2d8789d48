// SPDX-License-Identifier: LGPL-2.1-or-later
// Moved walls on whole meshes; see tests/python/test_reshape.py for random ones.
#include "operators/reshape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cancel.h"
#include "cutting/motion_error.h"
#include "groups/group_nodes.h"
#include "groups/group_report.h"
#include "mesh/quality.h"
#include "mesh/stopwatch.h"
#include "operators/drill.h"
#include "operators/reshape_part.h"
#include "operators/revolved_share.h"
#include "simple_meshes.h"
#include "tools/cone.h"
#include "tools/cylinder.h"
#include "tools/plane.h"
#include "tools/torus.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::HasSubstr;

/// A block of 12 x 4 x 4 with the nodes of its end in a group.
Mesh block(bool second_order = false) {
    Mesh mesh = checks::grid(12, 4, 4);
    if (second_order) mesh = checks::second_order(mesh);
    const FamilyIndex family = checks::family_of(mesh, "END", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.points[n].x() == 12) mesh.node_families[n] = family;
    return mesh;
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (const CellBlock& b : mesh.blocks())
        if (traits(b.type).dimension == 3)
            for (Index c = 0; c < b.size(); ++c) sum += cell_measure(mesh, b.type, c);
    return sum;
}

ReshapeOptions by(double x, double y = 0, double z = 0) {
    ReshapeOptions out;
    out.by = Vec3(x, y, z);
    return out;
}

std::string refusal(const Mesh& mesh, const char* group, const ReshapeOptions& options, const char* parameter) {
    try {
        reshape(mesh, group, options);
    } catch (const Error& e) {
        EXPECT_STREQ(e.parameter(), parameter) << e.what();
        return e.what();
    }
    ADD_FAILURE() << "no error";
    return "";
}

TEST(Reshape, OnlyTheBandChanges) {
    for (const bool second_order : {false, true}) {
        const Mesh mesh = block(second_order);
        const Result result = reshape(mesh, "END", by(1.5));
        EXPECT_NEAR(volume(result.mesh), 13.5 * 16, 1e-9);
        result.mesh.validate();
        Index same = 0;
        for (Index n = 0; n < mesh.node_count(); ++n) {
            EXPECT_EQ(result.mesh.node_ids[n], mesh.node_ids[n]);
            same += result.mesh.points[n] == mesh.points[n];
            if (mesh.points[n].x() < 5) {
                EXPECT_EQ(result.mesh.points[n], mesh.points[n]);
            }
            if (mesh.points[n].x() == 12) {
                EXPECT_EQ(result.mesh.points[n].x(), 13.5);
            }
        }
        EXPECT_EQ(result.report.nodes_moved, mesh.node_count() - same);
        EXPECT_EQ(checks::members(result.mesh, "SHAPE_WALL", GroupKind::node),
                  checks::members(mesh, "END", GroupKind::node));
        EXPECT_GT(result.report.quality_after.minimum, 0.4);
    }
}

TEST(Reshape, AlongTheWallIsNoMotion) {
    const Result result = reshape(block(), "END", by(1, 3, -2));
    EXPECT_NEAR(volume(result.mesh), 13 * 16, 1e-9);
}

TEST(Reshape, MidSideNodesOfAHoleLieOnTheTool) {
    const Cylinder hole({6, 2, 0}, {0, 0, 1}, 0.9), wider({6, 2, 0}, {0, 0, 1}, 1.4);
    const Tool* tools[] = {&hole};
    const Mesh drilled = drill(block(true), tools).mesh;
    ReshapeOptions options;
    options.onto = &wider;
    const Result result = reshape(drilled, "HOLE_WALL", options);
    const GroupIndex wall = *result.mesh.find_group("SHAPE_WALL");
    int count = 0;
    for (Index n = 0; n < result.mesh.node_count(); ++n) {
        if (!result.mesh.families.contains(result.mesh.node_families[n], wall)) continue;
        ++count;
        EXPECT_NEAR(wider.distance(result.mesh.points[n]), 0, 1e-9);
    }
    EXPECT_GT(count, 100);
    ReshapeOptions scaled;
    scaled.scale = {1.4 / 0.9, {6, 2, 77}};
    const Result same = reshape(drilled, "HOLE_WALL", scaled);
    EXPECT_NEAR(volume(same.mesh), volume(result.mesh), 1e-6 * volume(result.mesh));
}

TEST(Reshape, WhatIsWrongIsNamed) {
    const Mesh mesh = block();
    const Plane plane({13, 0, 0}, {1, 0, 0}), across({0, 1.5, 0}, {0, 1, 0});
    EXPECT_THAT(refusal(mesh, "NOWHERE", by(1), "group"), HasSubstr("no group 'NOWHERE'"));
    EXPECT_THAT(refusal(mesh, "END", {}, "onto"), HasSubstr("none of onto, by and scale"));
    ReshapeOptions both = by(1);
    both.onto = &plane;
    EXPECT_THAT(refusal(mesh, "END", both, "by"), HasSubstr("more than one"));
    refusal(mesh, "END", by(0), "by");
    ReshapeOptions scaled;
    scaled.scale = {-1, Vec3::Zero()};
    EXPECT_THAT(refusal(mesh, "END", scaled, "scale"), HasSubstr("must be positive"));
    EXPECT_THAT(refusal(mesh, "END", by(-12.5), "by"), HasSubstr("cannot be moved so far"));
    ReshapeOptions wrong;
    wrong.onto = &across;
    refusal(mesh, "END", wrong, "onto");
    ReshapeOptions named = by(1);
    named.name = "A B";
    refusal(mesh, "END", named, "name");
}

TEST(Reshape, NotThroughAnotherPart) {
    Mesh mesh = block();
    const Mesh other = block();
    const Index first = mesh.node_count();
    for (const Vec3& x : other.points) mesh.add_node(x + Vec3(14, 0.3, 0.2), mesh.largest_node_id() + 1);
    for (Index c = 0; c < other.block(CellType::tetra).size(); ++c) {
        std::array<Index, 4> nodes;
        for (int k = 0; k < 4; ++k) nodes[k] = first + other.block(CellType::tetra).nodes(c)[k];
        mesh.add_cell(CellType::tetra, nodes, mesh.largest_cell_id() + 1);
    }
    EXPECT_NO_THROW(reshape(mesh, "END", by(1.9)));
    EXPECT_THAT(refusal(mesh, "END", by(2.2), "by"), HasSubstr("another part of the mesh"));
}

/// The share of a motion that an error says works.
double told_share(const std::string& message) {
    const std::size_t end = message.find(" % of the motion works");
    EXPECT_NE(end, std::string::npos) << message;
    return end == std::string::npos ? 0 : std::stod(message.substr(message.rfind(' ', end - 1)));
}

TEST(Reshape, SaysHowMuchOfAMotionWorks) {
    Mesh mesh = block();
    const FamilyIndex other = checks::family_of(mesh, "OTHER", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.points[n].x() == 0) mesh.node_families[n] = other;
    const std::string message = refusal(mesh, "END", by(-12.5), "by");
    EXPECT_THAT(message, HasSubstr("The nearest other group is 'OTHER', "));
    const double share = told_share(message);
    EXPECT_GE(share, 25);  // more where time is left to try
    EXPECT_LE(share, 95);
    const double told = std::stod(message.substr(message.find("by=(") + 4));
    EXPECT_NEAR(told, -12.5 * share / 100, 0.01);
    EXPECT_GT(reshape(mesh, "END", by(told)).report.quality_after.minimum, 0.05);

    const Plane far(Vec3(-0.5, 0, 0), Vec3(1, 0, 0));
    ReshapeOptions onto;
    onto.onto = &far;
    const std::string of_plane = refusal(mesh, "END", onto, "onto");
    const double place = std::stod(of_plane.substr(of_plane.find("onto=Plane((") + 12));
    EXPECT_NEAR(place, 12 - 12.5 * told_share(of_plane) / 100, 0.01);
    const Plane less(Vec3(place, 0, 0), Vec3(1, 0, 0));
    onto.onto = &less;
    EXPECT_NEAR(volume(reshape(mesh, "END", onto).mesh), 16 * place, 1e-9);

    ReshapeOptions scaled;
    scaled.scale = {.factor = -0.5, .centre = Vec3::Zero()};
    EXPECT_THAT(refusal(mesh, "END", scaled, "scale"), HasSubstr("positive"));
}

TEST(Reshape, SaysWhereAMotionFails) {
    EXPECT_THAT(refusal(block(), "END", by(-12.5), "by"), HasSubstr("near ("));
    EXPECT_THAT(refusal(block(), "EMD", by(1), "group"), HasSubstr("Did you mean 'END'?"));
}

TEST(ReshapePart, IsThatMuchOfAMotion) {
    const Mesh mesh = block();
    const GroupIndex end = *mesh.find_group("END", GroupKind::node);
    EXPECT_EQ(std::ranges::count(nodes_of_group(mesh, end), 1), 25);
    EXPECT_EQ(part_of_motion(mesh, end, by(-3, 0, 1), 0.25)->text, "by=(-0.75, 0, 0.25)");
    ReshapeOptions scaled;
    scaled.scale = {.factor = 3, .centre = Vec3(1, 2, 3)};
    EXPECT_EQ(part_of_motion(mesh, end, scaled, 0.25)->text, "scale=(1.5, (1, 2, 3))");
    const Plane plane(Vec3(20, 0, 0), Vec3(2, 0, 0));
    ReshapeOptions onto;
    onto.onto = &plane;
    const auto part = part_of_motion(mesh, end, onto, 0.25);
    EXPECT_EQ(part->text, "onto=Plane((14, 0, 0), (1, 0, 0))");
    EXPECT_EQ(part->options.onto, part->tool.get());
    const MotionError error("", "by", Vec3(12, 0, 0));
    EXPECT_EQ(where_text(mesh, "", error), ". The nearest other group is 'END', there.");
    EXPECT_EQ(where_text(mesh, "END", error), ".");
}

/// The text of a part of the motion of a drilled block's hole, of radius 0.9, onto a tool; its nodes are on that part.
std::string part_onto(const Tool& tool, double share) {
    const Cylinder hole({6, 2, 0}, {0, 0, 1}, 0.9);
    const Tool* tools[] = {&hole};
    const Mesh mesh = drill(block(), tools).mesh;
    ReshapeOptions onto;
    onto.onto = &tool;
    const auto part = part_of_motion(mesh, *mesh.find_group("HOLE_WALL"), onto, share);
    return part ? part->text : "none";
}

TEST(ReshapePart, OfAMotionOntoAConeIsACone) {
    EXPECT_EQ(part_onto(Cone({6, 2, 2}, {0, 0, 1}, 1.3, 20), 0), "onto=Cylinder((6, 2, 2), (0, 0, 1), 0.9)");
    // tan(20 degrees) / 2 is tan(10.314 degrees)
    EXPECT_EQ(part_onto(Cone({6, 2, 2}, {0, 0, 1}, 1.3, 20), 0.5), "onto=Cone((6, 2, 2), (0, 0, 1), 1.1, 10.314)");
    EXPECT_EQ(part_onto(Cone({6, 2, 2}, {0, 0, -1}, 1.3, 20), 1), "onto=Cone((6, 2, 2), (0, 0, -1), 1.3, 20)");
    EXPECT_EQ(part_onto(Cone({6, 2.5, 2}, {0, 0, 1}, 1.3, 20), 0.5), "none");  // about another axis
}

TEST(ReshapePart, OfAMotionOntoATorusIsATorus) {
    // Nodes on the torus of the same axis with radii 6 and 1.
    Mesh mesh;
    const FamilyIndex family = checks::family_of(mesh, "WALL", GroupKind::node);
    for (int k = 0; k < 7; ++k)
        for (int j = 0; j < 5; ++j) {
            const double around = 0.3 * k, turn = 0.2 * j, far = 6 + std::cos(turn);
            mesh.add_node({far * std::cos(around), far * std::sin(around), 2 + std::sin(turn)}, mesh.node_count() + 1);
            mesh.node_families.back() = family;
        }
    ReshapeOptions onto;
    const auto text = [&](const Torus& torus, double share) {
        onto.onto = &torus;
        const auto part = part_of_motion(mesh, *mesh.find_group("WALL"), onto, share);
        return part ? part->text : "none";
    };
    EXPECT_EQ(text(Torus({0, 0, 2}, {0, 0, 1}, 6, 2), 0.25), "onto=Torus((0, 0, 2), (0, 0, 1), 6, 1.25)");
    EXPECT_EQ(text(Torus({0, 0, 4}, {0, 0, 1}, 8, 2), 0.25), "onto=Torus((0, 0, 2.5), (0, 0, 1), 6.5, 1.25)");
    EXPECT_EQ(revolved_between(mesh.points, Torus({1, 0, 2}, {0, 0, 1}, 6, 2), 0.25, 1e-6), nullptr);
}

/// Looks at a motion as long as it is let.
void look_for_ever(const ReshapeOptions& /*part*/) {
    for (;;) check_cancelled();
}

TEST(ReshapePart, IsLookedForAsLongAsTold) {
    const Mesh mesh = block();
    const GroupIndex end = *mesh.find_group("END", GroupKind::node);
    const Stopwatch::Time started = Stopwatch::now();
    EXPECT_EQ(advice_on_motion(mesh, end, by(-12.5), look_for_ever, look_for_ever, 0.2), " Move it less");
    EXPECT_GE(Stopwatch::since(started), 0.2);
    EXPECT_LT(Stopwatch::since(started), 2);
}

TEST(ReshapePart, IsLookedForUntilCancelled) {
    const Mesh mesh = block();
    const GroupIndex end = *mesh.find_group("END", GroupKind::node);
    const CancelToken token;
    const CancelScope scope(token);
    const auto cancel_meanwhile = [&](const ReshapeOptions& part) {
        token.cancel();
        look_for_ever(part);
    };
    const Stopwatch::Time started = Stopwatch::now();
    EXPECT_THROW(advice_on_motion(mesh, end, by(-12.5), cancel_meanwhile, look_for_ever, 60), Cancelled);
    EXPECT_LT(Stopwatch::since(started), 2);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
