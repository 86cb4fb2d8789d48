// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/beams.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "cutting/split_beams.h"
#include "operators/cut_beams_first.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "tools/sphere.h"

namespace femscalpel {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

Blade blade(const Tool& tool) {
    Blade out;
    out.tool = &tool;
    return out;
}

BeamCuts cuts_of(const Mesh& mesh, const Tool& tool) {
    const Blade one = blade(tool);
    return find_beam_cuts(mesh, std::span(&one, 1));
}

/// A beam along x from 0 to 4, number 7, and whether its middle is a node.
Mesh one_beam(bool second_order, double sag = 0) {
    Mesh mesh;
    mesh.add_node({0, 0, 0}, 1);
    mesh.add_node({4, 0, 0}, 2);
    if (second_order) mesh.add_node({2, sag, 0}, 3);
    const std::array<Index, 3> nodes{0, 1, 2};
    mesh.add_cell(second_order ? CellType::line3 : CellType::line, std::span(nodes).first(second_order ? 3 : 2), 7);
    return mesh;
}

TEST(Beams, AreCutWhereAToolPasses) {
    const BeamCuts found = cuts_of(one_beam(false), Plane({1, 0, 0}, {1, 0, 0}));
    ASSERT_THAT(found.cuts, SizeIs(1));
    EXPECT_THAT(found.cuts[0].at, ElementsAre(DoubleNear(0.25, 1e-12)));
    EXPECT_THAT(found.stops, IsEmpty());
}

TEST(Beams, AreCutTwiceByASphereBetweenTheirEnds) {
    const BeamCuts found = cuts_of(one_beam(false), Sphere({2, 0, 0}, 0.5));
    ASSERT_THAT(found.cuts, SizeIs(1));
    EXPECT_THAT(found.cuts[0].at, ElementsAre(DoubleNear(0.375, 1e-9), DoubleNear(0.625, 1e-9)));
}

TEST(Beams, BentOnesAreCutWhereTheyBend) {
    // y = sag (1 - (1 - x/2)^2) is 0.75 of it at x = 1 and 3.
    const BeamCuts found = cuts_of(one_beam(true, 1), Plane({0, 0.75, 0}, {0, 1, 0}));
    ASSERT_THAT(found.cuts, SizeIs(1));
    EXPECT_THAT(found.cuts[0].at, ElementsAre(DoubleNear(0.25, 1e-9), DoubleNear(0.75, 1e-9)));
}

TEST(Beams, AreCutInTheNodeThatIsNear) {
    const BeamCuts found = cuts_of(one_beam(false), Plane({1e-3, 0, 0}, {1, 0, 0}));
    EXPECT_THAT(found.cuts, IsEmpty());
    EXPECT_THAT(found.stops, ElementsAre(0));
    EXPECT_TRUE(cuts_of(one_beam(false), Plane({0, 0, 0}, {1, 0, 0})).empty()) << "on the tool";
}

TEST(Beams, EdgesOfOtherElementsAreNone) {
    Mesh mesh = checks::grid(2, 1, 1);
    mesh.add_cell(CellType::line,
                  std::array{checks::number_near(mesh, {0, 0, 0}), checks::number_near(mesh, {1, 0, 0})}, 3000);
    EXPECT_TRUE(cuts_of(mesh, Plane({0.5, 0, 0}, {1, 0, 0})).empty());
}

TEST(Beams, OutsideTheBoundAreLeft) {
    const Plane plane({1, 0, 0}, {1, 0, 0});
    Blade one = blade(plane);
    one.bound = [](const Vec3& x) { return x.y() + 1; };
    EXPECT_TRUE(find_beam_cuts(one_beam(false), std::span(&one, 1)).empty());
    one.bound = [](const Vec3& x) { return x.y() - 1; };
    EXPECT_FALSE(find_beam_cuts(one_beam(false), std::span(&one, 1)).empty());
}

TEST(SplitBeams, KeepTheShapeOfABentOne) {
    const Mesh mesh = one_beam(true, 1);
    const Simplified out = split_beams(mesh, {{{{CellType::line3, 0}, {0.25}}}, {}}, {100, 200});
    const CellBlock& beams = out.mesh.block(CellType::line3);
    ASSERT_EQ(beams.size(), 3) << "its middle node is an end, too";
    EXPECT_THAT(beams.ids, ElementsAre(7, 200, 201));
    const auto parabola = [](const Vec3& x) { return 1 - (1 - x.x() / 2) * (1 - x.x() / 2); };
    for (const Vec3& x : out.mesh.points) EXPECT_NEAR(x.y(), parabola(x), 1e-15);
    EXPECT_EQ(beams.nodes(0)[0], 0);
    EXPECT_EQ(beams.nodes(1)[1], 2);
    EXPECT_EQ(beams.nodes(2)[1], 1);
    for (Index k = 0; k < 3; ++k) {
        const auto n = beams.nodes(k);
        EXPECT_NEAR(out.mesh.points[n[2]].x(), (out.mesh.points[n[0]].x() + out.mesh.points[n[1]].x()) / 2, 1e-15);
    }
    EXPECT_EQ(out.beams_cut, 1);
    EXPECT_THAT(out.changes.parts, SizeIs(2));
}

TEST(CutBeamsFirst, TellsStopsByNumber) {
    const Mesh mesh = one_beam(false);
    const Plane near_end({4 - 1e-3, 0, 0}, {1, 0, 0}), between({1, 0, 0}, {1, 0, 0}), beside({5, 0, 0}, {1, 0, 0});
    const Blade at_end = blade(near_end), inside = blade(between), outside = blade(beside);
    const auto stopped = cut_beams_first(mesh, std::span(&at_end, 1), {});
    ASSERT_TRUE(stopped);
    EXPECT_FALSE(stopped->divided);
    EXPECT_THAT(stopped->stops, ElementsAre(2));
    const auto divided = cut_beams_first(mesh, std::span(&inside, 1), {});
    ASSERT_TRUE(divided && divided->divided);
    EXPECT_EQ(divided->divided->mesh.block(CellType::line).size(), 2);
    EXPECT_FALSE(cut_beams_first(mesh, std::span(&outside, 1), {}));
}

}  // namespace
}  // namespace femscalpel
