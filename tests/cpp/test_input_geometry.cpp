// SPDX-License-Identifier: LGPL-2.1-or-later
// Points of second-order elements while these are divided.
#include "cutting/input_geometry.h"

#include <gtest/gtest.h>

#include <array>

namespace femscalpel {
namespace FILE_NAMESPACE {

/// Two triangles (0 1 2, 1 3 2); the edge 0-1 is bent by 0.2.
Mesh two_triangles() {
    Mesh mesh;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(2, 2, 0), Vec3(1, 0.2, 0), Vec3(1, 1, 0),
                           Vec3(0, 1, 0), Vec3(2, 1, 0), Vec3(1, 2, 0)})
        mesh.add_node(at, mesh.node_count() + 1);
    mesh.add_cell(CellType::triangle6, std::array<Index, 6>{0, 1, 2, 4, 5, 6}, 1);
    mesh.add_cell(CellType::triangle6, std::array<Index, 6>{1, 3, 2, 7, 8, 5}, 2);
    return mesh;
}

struct InputGeometryTest : testing::Test {
    Mesh mesh = two_triangles();
    BandMesh band = extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0));
    MidSides mids{band, mesh};
};

TEST_F(InputGeometryTest, MiddlesOfItsEdgesAreItsMidSideNodes) {
    const InputGeometry geometry(band, mids, mesh);
    EXPECT_EQ(geometry.middle(0, 1), Vec3(1, 0.2, 0));
    EXPECT_EQ(geometry.middle(3, 1), Vec3(2, 1, 0));
}

TEST_F(InputGeometryTest, PointsInsideFollowTheShapeFunctions) {
    InputGeometry geometry(band, mids, mesh);
    geometry.add_node(0, 1);
    const int born = band.split_edge(0, 1, Vec3(1, 0.2, 0));
    // At l = (1/4, 1/4, 1/2): the bend counts 4 l0 l1 = 1/4.
    EXPECT_LT((geometry.middle(born, 2) - Vec3(0.5, 1 + 0.25 * 0.2, 0)).norm(), 1e-15);
    // On the curve, at l = (3/4, 1/4).
    EXPECT_LT((geometry.middle(born, 0) - Vec3(0.5, 0.75 * 0.2, 0)).norm(), 1e-15);
    // Where nodes are now makes no difference.
    band.nodes[born].at = {7, 7, 7};
    EXPECT_LT((geometry.middle(born, 2) - Vec3(0.5, 1.05, 0)).norm(), 1e-15);
}

TEST_F(InputGeometryTest, KnowsWhichElementsAreCurved) {
    const InputGeometry geometry(band, mids, mesh);
    EXPECT_TRUE(geometry.is_curved_around(0));
    EXPECT_TRUE(geometry.is_curved_around(2)) << "by its other element";
    EXPECT_FALSE(geometry.is_curved_around(3));
}

TEST_F(InputGeometryTest, CountsMidSideNodesThatWereMended) {
    mids.mend(0, 1, Vec3(0, 0.1, 0));
    const InputGeometry geometry(band, mids, mesh);
    EXPECT_LT((geometry.middle(0, 1) - Vec3(1, 0.1, 0)).norm(), 1e-15);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
