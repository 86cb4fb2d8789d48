// SPDX-License-Identifier: LGPL-2.1-or-later
// Where meshes touch, by facets.
#include "cutting/touching_faces.h"

#include <gtest/gtest.h>

#include "mesh/near_boxes.h"
#include "mesh/outer_faces.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

Mesh moved(Mesh mesh, const Vec3& by) {
    for (Vec3& x : mesh.points) x += by;
    return mesh;
}

Mesh wall(const Vec3& origin, int nx, int ny) {
    Mesh mesh;
    checks::add_plate(mesh, origin, {1, 0, 0}, {0, 0, 1}, nx, ny);
    return mesh;
}

/// A cube of one hexahedron at the origin, with a quadrangle on its top if so wanted.
Mesh cube(bool with_face = false) {
    Mesh mesh;
    const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (Index n = 0; n < 8; ++n) mesh.add_node(corners[n], n + 1);
    const Index all[] = {0, 1, 2, 3, 4, 5, 6, 7}, top[] = {4, 5, 6, 7};
    mesh.add_cell(CellType::hexahedron, all, 1);
    if (with_face) mesh.add_cell(CellType::quad, top, 2);
    return mesh;
}

TEST(NearBoxes, AreThePairsThatMeet) {
    using Box = Eigen::AlignedBox3d;
    const std::vector<Box> first{Box(Vec3(0, 0, 0), Vec3(1, 1, 1)), Box(Vec3(5, 0, 0), Vec3(6, 1, 1))},
        second{Box(Vec3(5.5, 0, 0), Vec3(7, 1, 1)), Box(Vec3(1, 1, 1), Vec3(5, 2, 2))};
    EXPECT_EQ(near_boxes(first, second), (std::vector<std::pair<int, int>>{{0, 1}, {1, 0}, {1, 1}}));
    EXPECT_TRUE(near_boxes(first, {}).empty());
    const BoxTree tree(first);
    EXPECT_TRUE(tree.meets(second[0]) && tree.meets(second[1]));
    EXPECT_FALSE(tree.meets(Box(Vec3(2, 0, 0), Vec3(4, 1, 1))) || BoxTree({}).meets(second[0]));
}

TEST(OuterFaces, OfSolidsAreTrianglesWithNormalsOut) {
    for (const Mesh& mesh : {cube(), cube(true), checks::grid(2, 2, 2)}) {
        const OuterFaces out = outer_faces(mesh, box_around(mesh));
        EXPECT_EQ(out.triangles.size(), mesh.block(CellType::tetra).size() > 0 ? 48u : 12u);
        EXPECT_TRUE(out.edges.empty());
        double volume = 0;
        for (const SurfaceFace& f : out.triangles) {
            EXPECT_FALSE(f.shell);
            volume += mesh.points[f.nodes[0]].dot(mesh.points[f.nodes[1]].cross(mesh.points[f.nodes[2]])) / 6;
        }
        EXPECT_NEAR(volume, mesh.block(CellType::tetra).size() > 0 ? 8 : 1, 1e-12);
    }
}

TEST(OuterFaces, OfAShellHaveItsBorder) {
    const Mesh mesh = wall({0, 0, 0}, 3, 2);
    const OuterFaces out = outer_faces(mesh, box_around(mesh));
    EXPECT_EQ(out.triangles.size(), 12u);
    EXPECT_EQ(out.edges.size(), 10u);
    for (const OuterFaces::Edge& e : out.edges) {
        EXPECT_GE(e.facet.face, 3);
        const auto nodes = mesh.block(e.facet.type).nodes(e.facet.cell);
        EXPECT_EQ(nodes[e.facet.face - 3], e.nodes[0]);
    }
    const Eigen::AlignedBox3d corner(Vec3(-0.1, -0.1, -0.1), Vec3(0.1, 0.1, 0.1));
    EXPECT_LT(outer_faces(mesh, corner).triangles.size(), 12u);
}

TEST(TouchingFaces, OfSolidsOnEachOther) {
    const TouchingFaces out = touching_faces(checks::grid(3, 3, 1), moved(cube(), {1, 1, 1}), {});
    ASSERT_EQ(out.facets[0].size(), 2u);
    ASSERT_EQ(out.facets[1].size(), 1u);
    EXPECT_EQ(out.facets[1][0].type, CellType::hexahedron);
    EXPECT_EQ(out.facets[1][0].face, 1);  // CalculiX's S1: nodes 1 to 4
    EXPECT_FALSE(out.edges[0] || out.edges[1]);
    EXPECT_EQ(out.gap, 0);
    EXPECT_NEAR(out.tolerance, 0.1, 0.05);
}

TEST(TouchingFaces, WithinATolerance) {
    const Mesh base = checks::grid(3, 3, 1);
    const Mesh off = moved(cube(), {1, 1, 1.3});
    EXPECT_TRUE(touching_faces(base, off, {}).facets[0].empty());
    EXPECT_TRUE(touching_faces(base, off, 0.29).facets[0].empty());
    const TouchingFaces out = touching_faces(base, off, 0.31);
    EXPECT_EQ(out.facets[0].size(), 2u);
    EXPECT_NEAR(out.gap, 0.3, 1e-12);
    EXPECT_EQ(out.tolerance, 0.31);
}

TEST(TouchingFaces, OfAShellOnItsEdge) {
    const TouchingFaces out = touching_faces(checks::grid(3, 3, 1), wall({0, 1.5, 1}, 3, 1), {});
    EXPECT_EQ(out.facets[1].size(), 3u);
    EXPECT_TRUE(out.edges[1]);
    EXPECT_EQ(out.facets[0].size(), 6u);
    // An L: only the second's edge stands on the other.
    Mesh floor;
    checks::add_plate(floor, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, 3);
    const TouchingFaces corner = touching_faces(floor, wall({0, 0, 0}, 3, 1), {});
    EXPECT_TRUE(corner.edges[1] && !corner.edges[0]);
    EXPECT_EQ(corner.facets[1].size(), 3u);
}

TEST(TouchingFaces, OfWhatOverlapsAreRefused) {
    const Mesh base = checks::grid(3, 3, 3);
    for (const Vec3& by : {Vec3(1, 1, 1), Vec3(1, 1, 2.5), Vec3(2.5, 1.5, 1.5), Vec3(2, 2, 2.5), Vec3(0, 0, 0)})
        EXPECT_THROW(touching_faces(base, moved(cube(), by), {}), ToolError) << by.transpose();
    EXPECT_THROW(touching_faces(moved(cube(), {1, 1, 1}), base, {}), ToolError);
    EXPECT_THROW(touching_faces(base, wall({0, 1.5, 2}, 3, 3), {}), ToolError);
    for (const Vec3& by : {Vec3(3, 0, 0), Vec3(2.5, 3, 1.5), Vec3(-1, 1, 1)})
        EXPECT_FALSE(touching_faces(base, moved(cube(), by), {}).facets[0].empty()) << by.transpose();
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
