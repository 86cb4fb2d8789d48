// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "operators/poor.h"

#include "cutting/weld.h"
#include "simple_meshes.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// A cube of 4 x 4 x 4 cells with all nodes in the band, and a plane just above its middle.
struct PoorTest : testing::Test {
    Mesh mesh = checks::grid(4, 4, 4);
    Plane plane{{2, 2, 2.5}, {0, 0, 1}};

    Workpiece interface() const {
        const std::vector<std::int8_t> level(mesh.points.size(), 0);
        ConstraintOptions options;
        options.kept_hidden.assign(mesh.groups.size(), true);
        Workpiece f{.d = Deformable(extract_band(mesh, level), mesh, options), .tool = &plane, .tolerance = 1e-9};
        f.distance.assign(static_cast<std::size_t>(f.d.band.size()), 1);
        return f;
    }

    /// Elements above z = 3.
    void put_top_into(GroupIndex group) {
        CellBlock& tetras = mesh.block(CellType::tetra);
        for (Index c = 0; c < tetras.size(); ++c) {
            double z = 0;
            for (const Index n : tetras.nodes(c)) z += mesh.points[n].z() / 4;
            if (z > 3) tetras.families[c] = mesh.families.with(tetras.families[c], group);
        }
    }

    static int node_at(const Workpiece& f, const Vec3& x) {
        for (int v = 0; v < f.d.band.size(); ++v)
            if ((f.d.band.nodes[v].at - x).norm() < 1e-9) return v;
        return -1;
    }
};

TEST_F(PoorTest, NothingIsSaidOfGoodElements) {
    Workpiece f = interface();
    EXPECT_TRUE(find_poor_places(f, mesh, 1).empty());
    EXPECT_TRUE(f.warnings.empty());
}

TEST_F(PoorTest, WhatHoldsIsNamed) {
    put_top_into(mesh.add_group("TOP", GroupKind::element));
    Workpiece f = interface();
    // Nearly onto the border of TOP, which is at z = 3.
    f.d.band.nodes[node_at(f, {2, 2, 2})].at.z() = 3 - 1e-4;
    const std::vector<PoorPlace> places = find_poor_places(f, mesh, 0.7);
    ASSERT_FALSE(places.empty());
    EXPECT_LT(places[0].mean_ratio, 0.02);
    EXPECT_THAT(places[0].groups, testing::ElementsAre("TOP"));
    EXPECT_FALSE(places[0].elements.empty());
    EXPECT_NEAR(places[0].gap, 0.5, 1e-3);
    EXPECT_NEAR(places[0].place.z(), 2.75, 0.3);
    ASSERT_EQ(f.warnings.size(), places.size());
    EXPECT_THAT(f.warnings[0], testing::AllOf(testing::HasSubstr("'TOP'"), testing::HasSubstr("preserve"),
                                              testing::HasSubstr("plane")));
}

TEST_F(PoorTest, ATenthOfTheInputsWorstIsAllowed) {
    Workpiece f = interface();
    f.d.band.nodes[node_at(f, {2, 2, 2})].at.z() = 3 - 1e-3;
    EXPECT_TRUE(find_poor_places(f, mesh, 1e-4).empty());
}

TEST_F(PoorTest, WhereNothingHoldsItIsAnError) {
    mesh = checks::grid(6, 6, 6);
    Workpiece f = interface();
    f.d.band.nodes[node_at(f, {3, 3, 3})].at.z() = 4 - 1e-4;
    EXPECT_THROW(find_poor_places(f, mesh, 0.7), QualityError);
}

TEST_F(PoorTest, HeldNodesAreCountedAndNamed) {
    Workpiece f = interface();
    EXPECT_EQ(find_held_nodes(f, mesh).count, 0);
    f.d.hold_beside(node_at(f, {0, 2, 2}), &plane);
    const HeldNodes held = find_held_nodes(f, mesh);
    EXPECT_EQ(held.count, 1);
    EXPECT_DOUBLE_EQ(held.largest, 0.5);
    EXPECT_THAT(held.features, testing::ElementsAre("the skin"));
    EXPECT_THAT(f.warnings, testing::ElementsAre(testing::HasSubstr("held by the skin")));
}

TEST_F(PoorTest, DoubleNodesAreNoCardOfTheSolversInput) {
    put_top_into(mesh.add_group(std::string(weld_group), GroupKind::element, true));
    Workpiece f = interface();
    f.d.hold_beside(node_at(f, {2, 2, 3}), &plane);
    EXPECT_THAT(find_held_nodes(f, mesh).features, testing::ElementsAre("double nodes"));
}

TEST_F(PoorTest, HeldNodesMayBeNew) {
    Workpiece f = interface();
    const int a = node_at(f, {0, 2, 2}), b = node_at(f, {0, 1, 2});
    const int born = f.split_edge(a, b, Vec3(0, 1.5, 2), {});
    f.d.hold_beside(born, &plane);
    EXPECT_EQ(find_held_nodes(f, mesh).count, 1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
