// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "operators/poor.h"

#include "cutting/weld.h"
#include "mesh/quality.h"
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

/// Two tetrahedra on one face, of which the second, number 8, is as high as told; node 4 is its tip.
Mesh two_tetras(double height) {
    Mesh mesh;
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(0.2, 0.2, height)})
        mesh.add_node(x, mesh.node_count() + 1);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 2, 1, 3}, 7);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 4}, 8);
    return mesh;
}

TEST(PoorestAt, IsOneOfTheElementsAtTheNodes) {
    const Mesh mesh = two_tetras(0.01);
    const PoorestElement poorest = poorest_at(mesh, {1});
    EXPECT_EQ(poorest.id, 8);
    EXPECT_NEAR(poorest.mean_ratio, mean_ratio(mesh, CellType::tetra, 1), 1e-15);
    EXPECT_NEAR(poorest.place.z(), 0.0025, 1e-12);
    EXPECT_EQ(poorest_at(mesh, {3}).id, 7);  // the other has not that node
    EXPECT_EQ(poorest_at(mesh, {}).id, -1);
}

TEST(CheckPoorest, RefusesWhatNothingWasSaidOf) {
    const PoorestElement poorest = poorest_at(two_tetras(1e-4), {4});
    ASSERT_LT(poorest.mean_ratio, 0.01);
    const auto check = [&](double before, std::vector<PoorPlace> said) {
        check_poorest(poorest, before, said, "Move it.", "other");
    };
    try {
        check(0.5, {});
        ADD_FAILURE() << "no error";
    } catch (const QualityError& e) {
        EXPECT_STREQ(e.parameter(), "other");
        EXPECT_THAT(e.what(), testing::StartsWith("an element near (    0.3     0.3 2.5e-05) would have"));
        EXPECT_THAT(e.what(), testing::EndsWith(". Move it."));
    }
    PoorPlace place;
    place.mean_ratio = poorest.mean_ratio;
    EXPECT_NO_THROW(check(0.5, {place}));
    place.mean_ratio = 2 * poorest.mean_ratio;
    EXPECT_THROW(check(0.5, {place}), QualityError);
    EXPECT_NO_THROW(check(5 * poorest.mean_ratio, {}));  // the input was hardly better
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
