// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/facet_element.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

Vec3 area(const Mesh& mesh, const FacetElement& f) {
    Vec3 sum = Vec3::Zero();
    const int corners = traits(f.type).corners;
    for (int k = 1; k + 1 < corners; ++k)
        sum += (mesh.points[f.nodes[k]] - mesh.points[f.nodes[0]])
                   .cross(mesh.points[f.nodes[k + 1]] - mesh.points[f.nodes[0]]) /
               2;
    return sum;
}

/// Faces of an element are a closed surface, their normals outwards, with the mid-side nodes in the middles.
void expect_closed(const Mesh& mesh, CellType type, double volume) {
    Vec3 sum = Vec3::Zero();
    double out = 0;
    for (std::size_t face = 1; face <= traits(type).faces.size(); ++face) {
        const FacetElement f = facet_element(mesh, {type, static_cast<std::int8_t>(face), 0, 0});
        EXPECT_EQ(f.size, traits(f.type).nodes);
        EXPECT_EQ(traits(f.type).quadratic, traits(type).quadratic);
        const Vec3 a = area(mesh, f);
        sum += a;
        out += a.dot(mesh.points[f.nodes[0]]) / 3;
        const CellTraits& t = traits(f.type);
        for (std::size_t e = 0; t.quadratic && e < t.edges.size(); ++e)
            EXPECT_EQ(mesh.points[f.nodes[t.corners + e]],
                      (mesh.points[f.nodes[t.edges[e][0]]] + mesh.points[f.nodes[t.edges[e][1]]]) / 2);
    }
    EXPECT_LT(sum.norm(), 1e-15);
    EXPECT_NEAR(out, volume, 1e-15) << "by the divergence theorem";
}

TEST(FacetElement, LooksOutOfSolids) {
    const Mesh tetras = checks::grid(1, 1, 1);
    expect_closed(tetras, CellType::tetra, 1.0 / 6);
    expect_closed(checks::second_order(tetras), CellType::tetra10, 1.0 / 6);
    Mesh cube;
    for (int k = 0; k < 8; ++k) cube.add_node(Vec3((k ^ (k >> 1)) & 1, 2 * (k >> 1 & 1), 3 * (k >> 2)), k + 1);
    cube.add_cell(CellType::hexahedron, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7}, 5);
    expect_closed(cube, CellType::hexahedron, 6);
    cube.add_cell(CellType::wedge, std::array<Index, 6>{0, 1, 2, 4, 5, 6}, 6);
    expect_closed(cube, CellType::wedge, 3);
}

TEST(FacetElement, OfShellsIsASideOrAnEdge) {
    Mesh mesh;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
        mesh.add_node(at, mesh.node_count() + 1);
    mesh.add_cell(CellType::triangle6, std::array<Index, 6>{0, 1, 2, 3, 4, 5}, 1);
    const FacetElement positive = facet_element(mesh, {CellType::triangle6, 2, 0, 0}),
                       negative = facet_element(mesh, {CellType::triangle6, 1, 0, 0}),
                       edge = facet_element(mesh, {CellType::triangle6, 4, 0, 0});
    EXPECT_EQ(area(mesh, positive), Vec3(0, 0, 2));
    EXPECT_EQ(area(mesh, negative), Vec3(0, 0, -2));
    EXPECT_EQ(positive.type, CellType::triangle6);
    EXPECT_EQ(edge.type, CellType::line3);
    EXPECT_THAT(std::vector<Index>(edge.nodes.begin(), edge.nodes.begin() + edge.size), testing::ElementsAre(1, 2, 4));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
