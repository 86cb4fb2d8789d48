// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/adjacency.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

/// A bar of three segments, a triangle at its end, and a point.
Mesh line_and_triangle() {
    Mesh mesh;
    for (int k = 0; k < 4; ++k) mesh.add_node(Vec3(k, 0, 0), k + 1);
    mesh.add_node({3, 1, 0}, 5);
    mesh.add_node({4, 0, 0}, 6);
    for (Index k = 0; k < 3; ++k) mesh.add_cell(CellType::line, std::array<Index, 2>{k, k + 1}, k + 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{3, 5, 4}, 10);
    mesh.add_cell(CellType::vertex, std::array<Index, 1>{3}, 11);
    return mesh;
}

TEST(Adjacency, VisitsElementsInTheMeshsOrder) {
    const Adjacency adjacency(line_and_triangle());
    const auto around = [&](Index node) {
        std::vector<std::pair<CellType, Index>> out;
        adjacency.around(node, [&](CellType type, Index cell) { out.push_back({type, cell}); });
        return out;
    };
    EXPECT_THAT(around(1), ElementsAre(Pair(CellType::line, 0), Pair(CellType::line, 1)));
    EXPECT_THAT(around(3),
                ElementsAre(Pair(CellType::vertex, 0), Pair(CellType::line, 2), Pair(CellType::triangle, 0)));
    EXPECT_THAT(around(4), ElementsAre(Pair(CellType::triangle, 0)));
}

TEST(Adjacency, GoesByCorners) {
    const Mesh mesh = checks::second_order(checks::grid(1, 1, 1));
    const Adjacency adjacency(mesh);
    int count = 0;
    for (Index n = 8; n < mesh.node_count(); ++n) adjacency.around(n, [&](CellType, Index) { ++count; });
    EXPECT_EQ(count, 0);
    adjacency.around(0, [&](CellType type, Index) { count += type == CellType::tetra10; });
    EXPECT_EQ(count, 6);
}

TEST(ElementsNear, FindsThoseWithACornerInTheBand) {
    const Mesh mesh = line_and_triangle();
    const Adjacency adjacency(mesh);
    for (const Adjacency* known : {static_cast<const Adjacency*>(nullptr), &adjacency}) {
        const CellLists near = elements_near(mesh, {-1, -1, 2, -1, 0, -1}, known);
        EXPECT_THAT(near[static_cast<int>(CellType::line)], ElementsAre(1, 2));
        EXPECT_THAT(near[static_cast<int>(CellType::triangle)], ElementsAre(0));
        EXPECT_THAT(near[static_cast<int>(CellType::vertex)], IsEmpty());
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
