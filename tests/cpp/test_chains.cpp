// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/chains.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/numbering.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;

TEST(Chains, OpenOnesFromTheirEndsThenClosedOnes) {
    const std::vector<std::array<int, 2>> edges{{1, 2}, {2, 3}, {1, 3}, {8, 9}, {5, 9}};
    EXPECT_THAT(chains_of(edges), ElementsAre(ElementsAre(5, 9, 8), ElementsAre(1, 2, 3, 1)));
}

TEST(Numbering, IsAboveTheLargest) {
    Mesh mesh;
    mesh.add_node(Vec3::Zero(), 7);
    mesh.add_cell(CellType::vertex, std::array<Index, 1>{0}, 4);
    const Numbering next = next_numbers(mesh);
    EXPECT_EQ(next.node, 8);
    EXPECT_EQ(next.cell, 5);
    mesh.node_ids[0] = Index{1} << 62;
    EXPECT_THROW(next_numbers(mesh), ToolError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
