// SPDX-License-Identifier: LGPL-2.1-or-later
// Where tools meet bars of cubes, each six tetrahedra.
#include "cutting/locate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "tools/sphere.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::HasSubstr;

Location locate_one(const Mesh& mesh, const Tool& tool, int levels) {
    const Blade blade{.tool = &tool, .bound = {}, .inside = {}};
    return locate(mesh, {&blade, 1}, levels);
}

/// Level of the nodes at each whole x; all of one x have the same here.
std::vector<int> levels_along_x(const Mesh& mesh, const std::vector<std::int8_t>& level) {
    std::vector<int> out;
    for (std::size_t n = 0; n < level.size(); ++n) {
        const auto x = static_cast<std::size_t>(mesh.points[n].x());
        if (out.size() <= x) out.resize(x + 1, level[n]);
        EXPECT_EQ(out[x], level[n]) << "node " << n;
    }
    return out;
}

TEST(Locate, FindsTheElementsThatAToolCrosses) {
    const Mesh mesh = checks::grid(5, 1, 1);
    const Location found = locate_one(mesh, Plane({1.5, 0, 0}, {1, 0, 0}), 2);
    EXPECT_EQ(found.crossed, 6);
    EXPECT_THAT(levels_along_x(mesh, found.level), testing::ElementsAre(1, 0, 0, 1, 2, -1));
    for (std::size_t n = 0; n < mesh.points.size(); ++n) EXPECT_EQ(found.distance[n], mesh.points[n].x() - 1.5);
    EXPECT_DOUBLE_EQ(found.tolerance, 1e-10 * std::sqrt(27.0));
    EXPECT_EQ(found.rounding, found.tolerance);
}

TEST(Locate, TouchesOnlyTheNodesOfAToolThatElementsEndAt) {
    const Mesh mesh = checks::grid(5, 1, 1);
    const Location found = locate_one(mesh, Plane({2, 0, 0}, {1, 0, 0}), 1);
    EXPECT_EQ(found.crossed, 0);
    EXPECT_THAT(levels_along_x(mesh, found.level), testing::ElementsAre(-1, 1, 0, 1, -1, -1));
}

TEST(Locate, DistancesAreThoseToTheFirstTool) {
    const Mesh mesh = checks::grid(5, 1, 1);
    const Plane first({4.5, 0, 0}, {1, 0, 0}), second({0.5, 0, 0}, {1, 0, 0});
    const Blade blades[] = {Blade{.tool = &first, .bound = {}, .inside = {}},
                            Blade{.tool = &second, .bound = {}, .inside = {}}};
    const Location found = locate(mesh, blades, 0);
    EXPECT_EQ(found.crossed, 12);
    EXPECT_THAT(levels_along_x(mesh, found.level), testing::ElementsAre(0, 0, -1, -1, 0, 0));
    EXPECT_EQ(found.distance[0], -4.5);
}

TEST(Locate, LeavesOutWhatIsFarBeyondABladesBound) {
    // Every tetrahedron here has an edge of sqrt(3), and is left out when it is 1.5 of that beyond: from y = 4 on.
    const Mesh mesh = checks::grid(1, 6, 1);
    const Plane plane({0.5, 0, 0}, {1, 0, 0});
    const Blade blade{.tool = &plane, .bound = [](const Vec3& x) { return x.y() - 1; }, .inside = {}};
    const Location found = locate(mesh, {&blade, 1}, 0);
    EXPECT_EQ(found.crossed, 24);
    for (std::size_t n = 0; n < mesh.points.size(); ++n) EXPECT_EQ(found.level[n] == 0, mesh.points[n].y() <= 4);
    const Blade nowhere{.tool = &plane, .bound = [](const Vec3&) { return 10.0; }, .inside = {}};
    EXPECT_THAT(
        [&] {
            locate(mesh, {&nowhere, 1}, 0);
        },
        testing::ThrowsMessage<ToolError>(HasSubstr("meets the mesh only outside the part of it")));
}

TEST(Locate, RefusesToolsThatMissTheMesh) {
    const Mesh mesh = checks::grid(1, 1, 1);
    EXPECT_THAT(
        [&] {
            locate_one(mesh, Plane({3, 0, 0}, {1, 0, 0}), 1);
        },
        testing::ThrowsMessage<ToolError>(HasSubstr("the plane misses the mesh")));
    EXPECT_THAT(
        [] {
            locate_one(Mesh(), Plane({3, 0, 0}, {1, 0, 0}), 1);
        },
        testing::ThrowsMessage<ToolError>(HasSubstr("the mesh is empty")));
}

TEST(Locate, KnowsHowCoarselyCoordinatesWereRounded) {
    Mesh mesh = checks::grid(5, 5, 5);
    for (Vec3& x : mesh.points) x = (x.array() + 1.23457).matrix();  // six digits, the last 1e-5
    const Location found = locate_one(mesh, Plane({2.234575, 0, 0}, {1, 0, 0}), 0);
    EXPECT_DOUBLE_EQ(found.rounding, 1e-5);
    EXPECT_EQ(found.crossed, 0) << "nodes half a unit of the last digit away are on the plane";
}

TEST(SpreadLevels, GoesFromEdgeToEdgeWithAndWithoutAdjacency) {
    const Mesh mesh = checks::grid(5, 1, 1);
    const Adjacency adjacency(mesh);
    for (const Adjacency* known : {static_cast<const Adjacency*>(nullptr), &adjacency}) {
        std::vector<std::int8_t> level(mesh.points.size(), -1);
        for (std::size_t n = 0; n < level.size(); ++n)
            if (mesh.points[n].x() == 0) level[n] = 0;
        spread_levels(mesh, level, 3, known);
        EXPECT_THAT(levels_along_x(mesh, level), testing::ElementsAre(0, 1, 2, 3, -1, -1));
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
