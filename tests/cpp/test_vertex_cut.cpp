// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/vertex_cut.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

namespace femscalpel {
namespace FILE_NAMESPACE {

using Weight = VertexCut::Weight;

/// The chain 0 - 1 - 2 - 3 - 4 with these weights, its ends held on the positive and the negative side.
std::vector<int> sides_of_chain(const std::array<Weight, 5>& weights) {
    VertexCut cut(5);
    for (int v = 0; v < 5; ++v) cut.set_weight(v, weights[v]);
    for (int v = 0; v < 4; ++v) cut.join(v, v + 1);
    cut.hold_positive(0, VertexCut::endless);
    cut.hold_negative(4, VertexCut::endless);
    EXPECT_TRUE(cut.solve());
    std::vector<int> out;
    for (int v = 0; v < 5; ++v) out.push_back(cut.side(v));
    return out;
}

TEST(VertexCut, OfAChainIsItsLightestNode) {
    EXPECT_THAT(sides_of_chain({9, 5, 2, 5, 9}), testing::ElementsAre(1, 1, 0, -1, -1));
    EXPECT_THAT(sides_of_chain({9, 5, 6, 3, 9}), testing::ElementsAre(1, 1, 1, 0, -1));
    EXPECT_THAT(sides_of_chain({1, 5, 6, 3, 9}), testing::ElementsAre(0, -1, -1, -1, -1));
}

TEST(VertexCut, OfEqualOnesIsTheNearestToThePositiveSide) {
    EXPECT_THAT(sides_of_chain({9, 2, 3, 2, 9}), testing::ElementsAre(1, 0, -1, -1, -1));
}

TEST(VertexCut, GoesRoundAHeavyNode) {
    // A grid of 3 x 3, the left column held positive, the right one negative. The middle of the middle column is too
    // heavy, so that the cut leads through the left column there.
    VertexCut cut(9);
    const auto at = [](int row, int column) { return 3 * row + column; };
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
            cut.set_weight(at(r, c), r == 1 && c == 1 ? 100 : c == 1 ? 1 : 10);
            if (c < 2) cut.join(at(r, c), at(r, c + 1));
            if (r < 2) cut.join(at(r, c), at(r + 1, c));
        }
    for (int r = 0; r < 3; ++r) {
        cut.hold_positive(at(r, 0), VertexCut::endless);
        cut.hold_negative(at(r, 2), VertexCut::endless);
    }
    ASSERT_TRUE(cut.solve());
    EXPECT_EQ(cut.side(at(0, 1)), 0);
    EXPECT_EQ(cut.side(at(1, 0)), 0);
    EXPECT_EQ(cut.side(at(1, 1)), -1);
    EXPECT_EQ(cut.side(at(2, 1)), 0);
    EXPECT_EQ(cut.side(at(0, 0)), 1);
    EXPECT_EQ(cut.side(at(1, 2)), -1);
}

TEST(VertexCut, SaysWhenNothingMayBeCut) {
    VertexCut cut(3);
    for (int v = 0; v < 3; ++v) cut.set_weight(v, VertexCut::endless);
    cut.join(0, 1);
    cut.join(1, 2);
    cut.hold_positive(0, VertexCut::endless);
    cut.hold_negative(2, VertexCut::endless);
    EXPECT_FALSE(cut.solve());
}

TEST(VertexCut, LetsANodeChangeItsSideWhereThatCostsLess) {
    // Both nodes want to be on different sides, the second a little less than either weighs.
    VertexCut cut(2);
    cut.set_weight(0, 10);
    cut.set_weight(1, 10);
    cut.join(0, 1);
    cut.hold_positive(0, 8);
    cut.hold_negative(1, 3);
    ASSERT_TRUE(cut.solve());
    EXPECT_EQ(cut.side(0), 1);
    EXPECT_EQ(cut.side(1), 1);
}

/// A graph of few nodes, and the cost of putting each on a side.
struct SmallGraph {
    static constexpr int size = 7;
    std::array<Weight, size> weight, positive, negative;
    std::vector<std::pair<int, int>> edges;

    /// -1 if an edge would lead from side to side.
    Weight cost(const std::array<int, size>& side) const {
        for (const auto& [a, b] : edges)
            if (side[a] * side[b] < 0) return -1;
        Weight sum = 0;
        for (int v = 0; v < size; ++v) sum += side[v] == 0 ? weight[v] : side[v] < 0 ? positive[v] : negative[v];
        return sum;
    }

    Weight least() const {
        Weight best = VertexCut::endless;
        std::array<int, size> side;
        for (int code = 0; code < 2187; ++code) {
            for (int v = 0, rest = code; v < size; ++v, rest /= 3) side[v] = rest % 3 - 1;
            if (const Weight now = cost(side); now >= 0) best = std::min(best, now);
        }
        return best;
    }
};

TEST(VertexCut, OfSmallGraphsIsTheLightestOfAll) {
    std::mt19937 random(1);
    int with_cut = 0;
    for (int round = 0; round < 200; ++round) {
        SmallGraph graph;
        VertexCut cut(SmallGraph::size);
        for (int v = 0; v < SmallGraph::size; ++v) {
            graph.weight[v] = 1 + random() % 9;
            graph.positive[v] = random() % 3 == 0 ? random() % 20 : 0;
            graph.negative[v] = random() % 3 == 0 ? random() % 20 : 0;
            cut.set_weight(v, graph.weight[v]);
            cut.hold_positive(v, graph.positive[v]);
            cut.hold_negative(v, graph.negative[v]);
            for (int w = 0; w < v; ++w)
                if (random() % 2 == 0) {
                    graph.edges.push_back({v, w});
                    cut.join(v, w);
                }
        }
        ASSERT_TRUE(cut.solve());
        std::array<int, SmallGraph::size> side;
        for (int v = 0; v < SmallGraph::size; ++v) side[v] = cut.side(v);
        EXPECT_EQ(graph.cost(side), graph.least()) << "graph " << round;
        with_cut += std::ranges::count(side, 0) > 0;
    }
    EXPECT_GT(with_cut, 50);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
