// SPDX-License-Identifier: LGPL-2.1-or-later
// What is said of tools that part nothing.
#include "cutting/no_cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "tools/sphere.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::AllOf;
using testing::HasSubstr;

std::string missed(const Mesh& mesh, const Tool& tool, bool beyond = false) {
    std::vector<double> distance;
    for (const Vec3& x : mesh.points) distance.push_back(tool.distance(x));
    return why_missed(mesh, {.tool = &tool, .bound = {}, .inside = {}}, distance, 1e-9, beyond);
}

TEST(WhyMissed, BesideTheWholeMesh) {
    const Mesh mesh = checks::grid(1, 1, 1);
    EXPECT_EQ(missed(mesh, Plane({-3, 0, 0}, {1, 0, 0})),
              "the plane misses the mesh: the whole mesh lies on its positive side, the nearest node at distance 3. "
              "Move the plane or turn it");
    EXPECT_THAT(missed(mesh, Plane({3, 0, 0}, {1, 0, 0})), HasSubstr("negative side, the nearest node at distance 2"));
    EXPECT_THAT(missed(Mesh(), Plane({3, 0, 0}, {1, 0, 0})), HasSubstr("it has no elements"));
}

TEST(WhyMissed, BetweenPartsOfTheMesh) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    checks::add_plate(mesh, {3, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    EXPECT_THAT(missed(mesh, Plane({1.5, 0, 0}, {1, 0, 0})),
                AllOf(HasSubstr("between parts of the mesh"),
                      HasSubstr("0.5 on its negative side and 1.5 on its positive side")));
}

TEST(WhyMissed, ThroughSegmentsOnly) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    checks::add_plate(mesh, {3, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    mesh.add_cell(CellType::line,
                  std::array{checks::number_near(mesh, {1, 0, 0}), checks::number_near(mesh, {3, 0, 0})}, 77);
    EXPECT_THAT(missed(mesh, Plane({1.5, 0, 0}, {1, 0, 0})),
                HasSubstr("it passes only through segments (element 77), which cannot be divided"));
}

TEST(WhyMissed, InsideAnElement) {
    const Mesh mesh = checks::grid(1, 1, 1);
    // The middle of the first tetrahedron.
    Vec3 middle = Vec3::Zero();
    for (const Index n : mesh.block(CellType::tetra).nodes(0)) middle += mesh.points[n] / 4;
    EXPECT_THAT(missed(mesh, Sphere(middle, 0.05)),
                AllOf(HasSubstr("the sphere lies inside element 100, between their nodes"),
                      HasSubstr("Refine the mesh there first")));
    Mesh cube;
    for (int k = 0; k < 8; ++k) cube.add_node(Vec3((k ^ (k >> 1)) & 1, k >> 1 & 1, k >> 2), k + 1);
    cube.add_cell(CellType::hexahedron, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7}, 5);
    EXPECT_THAT(missed(cube, Sphere({0.5, 0.5, 0.5}, 0.1)),
                AllOf(HasSubstr("element 5 (hexahedron)"), HasSubstr("Refine the mesh there first")));
}

TEST(LiesInsideElements, BetweenTheirNodesWithinThePart) {
    const Mesh mesh = checks::grid(1, 1, 1);
    Vec3 middle = Vec3::Zero();
    for (const Index n : mesh.block(CellType::tetra).nodes(0)) middle += mesh.points[n] / 4;
    const Sphere inside(middle, 0.05), beside({5, 5, 5}, 0.05);
    Blade blade;
    blade.tool = &inside;
    EXPECT_TRUE(lies_inside_elements(mesh, blade));
    blade.bound = [](const Vec3&) { return 1.0; };
    EXPECT_FALSE(lies_inside_elements(mesh, blade));
    blade = Blade();
    blade.tool = &beside;
    EXPECT_FALSE(lies_inside_elements(mesh, blade));
}

TEST(WhyMissed, ThroughCurvedSidesOnly) {
    Mesh mesh = checks::second_order(checks::grid(1, 1, 1));
    mesh.points[checks::number_near(mesh, {1, 0.5, 0.5})].x() = 1.2;
    EXPECT_THAT(missed(mesh, Plane({1.1, 0, 0}, {1, 0, 0})),
                AllOf(HasSubstr("only grazes the mesh"), HasSubstr("Move the plane into the material")));
}

TEST(WhyMissed, WhereItIsNotWanted) {
    EXPECT_THAT(missed(checks::grid(1, 1, 1), Plane({0.5, 0, 0}, {1, 0, 0}), true),
                HasSubstr("meets the mesh only outside the part of it that is to cut"));
}

std::string parts_nothing(const Mesh& mesh, const Tool& tool) {
    return why_nothing_parts(checks::whole_workpiece(mesh, tool), {.tool = &tool, .bound = {}, .inside = {}},
                             "something else");
}

TEST(WhyNothingParts, OnTheOutside) {
    const Mesh mesh = checks::grid(1, 1, 1);
    EXPECT_THAT(parts_nothing(mesh, Plane({0, 0, 0}, {1, 0, 0})),
                HasSubstr("only touches the mesh, on its outside: all elements there are on its positive side"));
    EXPECT_THAT(parts_nothing(mesh, Plane({1, 0, 0}, {1, 0, 0})), HasSubstr("are on its negative side"));
    EXPECT_EQ(parts_nothing(mesh, Plane({0.5, 0, 0}, {1, 0, 0})), "something else");
}

TEST(WhyNothingParts, OnFacesThatAreOpenAlready) {
    // Two cubes side by side, each with nodes of its own.
    Mesh mesh = checks::grid(1, 1, 1);
    const Mesh other = checks::grid(1, 1, 1);
    for (const Vec3& x : other.points) mesh.add_node(x + Vec3(1, 0, 0), mesh.largest_node_id() + 1);
    for (Index c = 0; c < 6; ++c) {
        std::array<Index, 4> nodes;
        std::ranges::transform(other.block(CellType::tetra).nodes(c), nodes.begin(), [](Index n) { return n + 8; });
        mesh.add_cell(CellType::tetra, nodes, 200 + c);
    }
    EXPECT_THAT(parts_nothing(mesh, Plane({1, 0, 0}, {1, 0, 0})), HasSubstr("on faces that are open already"));
    for (std::size_t n = 8; n < 16; ++n) mesh.points[n].y() += 0.25;
    EXPECT_THAT(parts_nothing(mesh, Plane({1, 0, 0}, {1, 0, 0})),
                HasSubstr("wherever it does, the elements are on one side of it only"));
}

TEST(WhyNothingParts, InShells) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1, 1);
    EXPECT_THAT(parts_nothing(mesh, Plane({0, 0, 0}, {0, 0, 1})),
                HasSubstr("2 shell elements lie in the plane, and nothing stands on them"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
