// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/quad_cuts.h"

#include <gtest/gtest.h>

#include "mesh/order.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

CellLists all_cells(const Mesh& mesh) {
    CellLists out;
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) out[static_cast<int>(b.type)].push_back(c);
    return out;
}

std::set<Index> diagonal_of(const std::vector<Vec3>& corners, std::vector<Index> numbers = {1, 2, 3, 4},
                            std::array<Index, 4> order = {0, 1, 2, 3}) {
    Mesh mesh;
    for (std::size_t k = 0; k < 4; ++k) mesh.add_node(corners[k], numbers[k]);
    mesh.add_cell(CellType::quad, order, 1);
    QuadCuts cuts(mesh, all_cells(mesh), [](const Blend&, const auto&) -> Index {
        ADD_FAILURE() << "no mid-side nodes";
        return -1;
    });
    const auto& ends = cuts.diagonal(order);
    return {ends[0], ends[1]};
}

TEST(QuadCuts, TakeTheBetterDiagonal) {
    const std::vector<Vec3> rhomb{{0, 0, 0}, {1, 0, 0}, {1.6, 0.9, 0}, {0.6, 0.9, 0}},
        square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, dented{{0, 0, 0}, {1, 0, 0}, {0.3, 0.3, 0}, {0, 1, 0}};
    EXPECT_EQ(diagonal_of(rhomb), (std::set<Index>{1, 3}));
    EXPECT_EQ(diagonal_of(dented), (std::set<Index>{0, 2})) << "the other is outside";
    EXPECT_EQ(diagonal_of(square), (std::set<Index>{0, 2}));
    EXPECT_EQ(diagonal_of(square, {5, 2, 3, 4}), (std::set<Index>{1, 3})) << "at the lowest number";
    for (const std::array<Index, 4>& order : {std::array<Index, 4>{2, 1, 0, 3}, {1, 2, 3, 0}})
        EXPECT_EQ(diagonal_of(square, {5, 2, 3, 4}, order), (std::set<Index>{1, 3})) << "from whichever element";
}

TEST(QuadCuts, ADiagonalIsBentAsTheShellIs) {
    Mesh mesh = to_second_order(checks::quadrangles(1, 1));
    const auto bent = [](const Vec3& x) { return Vec3(x[0], x[1], 0.1 * x[0] * x[0]); };
    for (Vec3& x : mesh.points) x = bent(x);
    Vec3 middle = Vec3::Zero();
    QuadCuts cuts(mesh, all_cells(mesh), [&](const Blend& at, const auto&) {
        middle = place_of(mesh, at);
        return mesh.add_node(middle, 100);
    });
    const auto& n = mesh.block(CellType::quad8).nodes(0);
    const auto triangles = cuts.triangles({n[0], n[1], n[2], n[3]});
    EXPECT_EQ(triangles[0], (std::array<Index, 3>{n[0], n[1], n[2]}));
    EXPECT_EQ(triangles[1], (std::array<Index, 3>{n[0], n[2], n[3]}));
    EXPECT_LT((middle - bent({0.5, 0.5, 0})).norm(), 1e-15);
    EXPECT_EQ(cuts.middle(n[2], n[0]), mesh.node_count() - 1);
    EXPECT_EQ(cuts.middle(n[1], n[3]), -1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
