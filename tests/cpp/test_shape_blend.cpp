// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/shape_blend.h"

#include <gtest/gtest.h>

#include "mesh/order.h"
#include "mesh/quality.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

Mesh element(CellType type) {
    Mesh mesh;
    const CellTraits& t = traits(type);
    std::vector<Index> nodes;
    for (int k = 0; k < t.corners; ++k) nodes.push_back(mesh.add_node(ShapeBlend::corner(type, k), k + 1));
    mesh.add_cell(t.linear, nodes, 1);
    return t.quadratic ? to_second_order(mesh) : mesh;
}

class ShapeBlends : public testing::TestWithParam<CellType> {};

TEST_P(ShapeBlends, AreTheElementsOwnShapeFunctions) {
    Mesh mesh = element(GetParam());
    const auto nodes = mesh.block(GetParam()).nodes(0);
    const ShapeBlend shape(GetParam(), nodes);
    const CellTraits& t = traits(GetParam());
    // A quadratic map that all of these elements hold exactly.
    const auto bent = [](const Vec3& x) { return Vec3(x + 0.1 * Vec3(x[1] * x[1], x[0] * x[1], x[0] * x[2])); };
    const Vec3 inside = t.dimension == 2 ? Vec3(0.2, -0.4, 0) : Vec3(0.2, 0.3, -0.4);
    EXPECT_LT((place_of(mesh, shape.at(inside)) - inside).norm(), 1e-14);
    EXPECT_LT(place_of(mesh, shape.bulge(inside)).norm(), 1e-14);
    if (t.quadratic) {
        for (Vec3& x : mesh.points) x = bent(x);
        EXPECT_LT((place_of(mesh, shape.at(inside)) - bent(inside)).norm(), 1e-14);
    }
    double sum = 0;
    for (const auto& [node, weight] : shape.at(inside)) sum += weight;
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_TRUE(ShapeBlend::inside(GetParam(), ShapeBlend::middle(GetParam()), 0.2));
    EXPECT_FALSE(ShapeBlend::inside(GetParam(), ShapeBlend::corner(GetParam(), 0), 0.1));
}

INSTANTIATE_TEST_SUITE_P(All, ShapeBlends,
                         testing::Values(CellType::quad, CellType::quad8, CellType::wedge, CellType::wedge15,
                                         CellType::hexahedron, CellType::hexahedron20),
                         [](const auto& info) { return std::string(traits(info.param).name); });

TEST(Blends, AddUpByNode) {
    Blend sum{{3, 0.5}};
    add(sum, {{1, 1}, {3, 0.5}}, 0.5);
    EXPECT_EQ(sum, (Blend{{1, 0.5}, {3, 0.75}}));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
