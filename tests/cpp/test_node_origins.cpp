// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/node_origins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

/// A tetrahedron with corners 1 to 4, of which node 4 moves; 5 is born between 1 and 2, 6 is a copy of 3, 7 one of 5.
struct NodeOriginsTest : testing::Test {
    NodeOriginsTest() {
        for (const Vec3& at : {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 4)})
            before.add_node(at, before.node_count() + 1);
        before.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 1);
        change(before);
    }
    void change(const Mesh& mesh) {
        after = mesh;
        after.points[3] = {0.5, 0, 3};
        after.add_node({1, 0, 0}, 5);
        after.add_node({0, 4, 0}, 6);
        after.add_node({1, 0, 0}, 7);
        changes = {};
        changes.born.push_back({5, {1, 2}});
        changes.copies.push_back({6, 3});
        changes.copies.push_back({7, 5});
    }
    /// Shares of a node by number.
    static std::map<Index, double> shares(const NodeOrigins& origins, Index number) {
        std::map<Index, double> out;
        for (std::size_t k = 0; k < origins.nodes().size(); ++k)
            if (origins.nodes()[k].number == number)
                for (const NodeOrigins::Share& s : origins.shares(k)) out[s.node] = s.weight;
        return out;
    }
    Mesh before, after;
    Changes changes;
};

TEST_F(NodeOriginsTest, AreOfNodesThatAreNewOrMoved) {
    const NumberIndex numbers(before), now(after);
    const NodeOrigins origins(before, numbers, after, now, changes);
    ASSERT_EQ(origins.nodes().size(), 4u);
    const NodeOrigins::Node &moved = origins.nodes()[0], &born = origins.nodes()[1], &copy = origins.nodes()[2],
                            &copy_of_born = origins.nodes()[3];
    EXPECT_EQ(moved.number, 4);
    EXPECT_FALSE(moved.is_new);
    EXPECT_NEAR(moved.moved, std::sqrt(1.25), 1e-15);
    EXPECT_THAT(moved.ancestors, ElementsAre(4));
    EXPECT_EQ(born.number, 5);
    EXPECT_TRUE(born.is_new);
    EXPECT_EQ(born.place, Vec3(1, 0, 0));
    EXPECT_THAT(born.ancestors, ElementsAre(1, 2));
    EXPECT_THAT(copy.ancestors, ElementsAre(3));
    EXPECT_THAT(copy_of_born.ancestors, ElementsAre(1, 2));
    EXPECT_EQ(origins.moved(4), moved.moved);
    EXPECT_EQ(origins.moved(1), 0);
    EXPECT_THAT(origins.copies_of(3), ElementsAre(6));
    EXPECT_TRUE(origins.is_doubled(5));
    EXPECT_FALSE(origins.is_doubled(1));
    EXPECT_THAT(origins.copies_of(1), IsEmpty());
}

TEST_F(NodeOriginsTest, SharesAreThoseOfTheShapeFunctions) {
    const NumberIndex numbers(before), now(after);
    const NodeOrigins origins(before, numbers, after, now, changes);
    using testing::DoubleNear;
    EXPECT_THAT(shares(origins, 5), ElementsAre(Pair(1, DoubleNear(0.75, 1e-14)), Pair(2, DoubleNear(0.25, 1e-14))));
    EXPECT_THAT(shares(origins, 4), ElementsAre(Pair(1, DoubleNear(0.125, 1e-14)), Pair(2, DoubleNear(0.125, 1e-14)),
                                                Pair(4, DoubleNear(0.75, 1e-14))));
    EXPECT_THAT(shares(origins, 6), ElementsAre(Pair(3, DoubleNear(1, 1e-14))));
}

TEST_F(NodeOriginsTest, SharesOfSecondOrderElementsHaveTheirMidSideNodes) {
    before = checks::second_order(before);  // nodes 5 to 10; 5 is between 1 and 2
    after = before;
    after.add_node({1, 0, 0}, 20);
    changes = {};
    changes.born.push_back({20, {1, 2}});
    const NumberIndex numbers(before), now(after);
    const NodeOrigins origins(before, numbers, after, now, changes);
    using testing::DoubleNear;
    // l1 (2 l1 - 1), l2 (2 l2 - 1), 4 l1 l2 at (3/4, 1/4).
    EXPECT_THAT(shares(origins, 20), ElementsAre(Pair(1, DoubleNear(0.375, 1e-14)), Pair(2, DoubleNear(-0.125, 1e-14)),
                                                 Pair(5, DoubleNear(0.75, 1e-14))));
}

TEST_F(NodeOriginsTest, NothingIsSharedFarOutsideTheElements) {
    after.points[4] = {-9, 0, 0};
    const NumberIndex numbers(before), now(after);
    EXPECT_THAT(shares(NodeOrigins(before, numbers, after, now, changes), 5), IsEmpty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
