// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes that equations relate, two sides of a block that move alike: what is born or doubled on one side is related to
// what is on the other, or it is told.
#include "deck/related_nodes.h"

#include <map>

#include "deck_testing.h"
#include "operators/refine.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Node `a` minus node `b` is zero, in one degree of freedom.
std::string equal(Index a, Index b, int dof) {
    return "2\n" + std::to_string(a) + ", " + std::to_string(dof) + ", 1., " + std::to_string(b) + ", " +
           std::to_string(dof) + ", -1.\n";
}

/// The sides y = 2 and y = 0 of the block move alike.
std::string periodic_in_y(int dofs = 3) {
    std::string out = "*EQUATION\n";
    for (int k = 0; k <= nz; ++k)
        for (int i = 0; i <= nx; ++i)
            for (int dof = 1; dof <= dofs; ++dof) out += equal(node_at(i, ny, k), node_at(i, 0, k), dof);
    return out;
}

struct Term {
    Index node;
    int dof;
    double factor;
};

std::vector<std::vector<Term>> equations(const Mesh& mesh) {
    std::vector<std::vector<Term>> out;
    std::size_t left = 0;
    for (const Row& r : rows(mesh, "EQUATION")) {
        if (left == 0) {
            left = std::stoul(r[0]);
            out.emplace_back();
            continue;
        }
        for (std::size_t k = 0; k + 2 < r.size(); k += 3, --left)
            out.back().push_back({std::stoll(r[k]), std::stoi(r[k + 1]), std::stod(r[k + 2])});
    }
    return out;
}

class RelatedNodesOfDeck : public DeckSemantics {
protected:
    /// Every node at y = 2 has one equation per degree of freedom, with the node at its place at y = 0, on the same
    /// side of the plane.
    void expect_periodic(const Mesh& after, const Plane& plane, int dofs = 3) {
        const NumberIndex numbers(after);
        std::map<Index, double> side;
        for (const CellBlock& b : after.blocks())
            for (Index c = 0; c < b.size() && traits(b.type).dimension == 3; ++c) {
                double sum = 0;
                for (const Index n : b.nodes(c)) sum += plane.distance(after.points[n]);
                for (const Index n : b.nodes(c)) side[after.node_ids[n]] = sum < 0 ? -1 : 1;
            }
        std::map<std::pair<Index, int>, Index> partner;
        for (const auto& e : equations(after)) {
            ASSERT_EQ(e.size(), 2u);
            EXPECT_EQ(e[0].dof, e[1].dof);
            EXPECT_EQ(e[0].factor, 1);
            EXPECT_EQ(e[1].factor, -1);
            EXPECT_TRUE(partner.emplace(std::pair(e[0].node, e[0].dof), e[1].node).second)
                << "node " << e[0].node << " is related twice";
            EXPECT_LT((place(after, e[0].node) - place(after, e[1].node) - Vec3(0, ny, 0)).norm(), 1e-12)
                << e[0].node << " " << e[1].node;
            EXPECT_EQ(side[e[0].node], side[e[1].node])
                << e[0].node << " and " << e[1].node << " are on different lips";
        }
        const auto wanted = nodes_where(after, [](const Vec3& p) { return p.y() == ny; });
        EXPECT_EQ(partner.size(), dofs * wanted.size());
        for (const Index n : wanted)
            for (int dof = 1; dof <= dofs; ++dof) EXPECT_TRUE(partner.contains({n, dof})) << n;
    }
};

TEST_F(RelatedNodesOfDeck, NodesBornOnMatchingSidesAreRelatedSideBySide) {
    const Mesh mesh = block_with(periodic_in_y());
    const auto size = equations(mesh).size();
    for (const auto& [x, normal] : {std::pair(1.5, Vec3(1, 0, 0)), std::pair(2.3, Vec3(1, 0, .2)),
                                    std::pair(1.6, Vec3(1, 0, -.4)), std::pair(2.0, Vec3(1, 0, 0))}) {
        SCOPED_TRACE(x);
        const Mesh after = crack_at(mesh, x, "CRACK", normal, true);
        EXPECT_GT(equations(after).size(), size + 8);
        EXPECT_THAT(warnings_, Not(Contains(HasSubstr("EQUATION"))));
        expect_periodic(after, Plane(Vec3(x, 1, 1), normal));
    }
}

TEST_F(RelatedNodesOfDeck, EachDegreeOfFreedomHasItsOwn) {
    // Only some nodes are related in the third: one born between two of which one is not is related in the others.
    std::string cards = periodic_in_y(2);
    cards += equal(node_at(1, ny, 1), node_at(1, 0, 1), 3) + equal(node_at(2, ny, 1), node_at(2, 0, 1), 3) +
             equal(node_at(1, ny, 2), node_at(1, 0, 2), 3);
    const Mesh after = crack_at(block_with(cards), 1.5, "CRACK", Vec3(1, 0, 0), true);
    std::map<int, std::set<std::pair<double, double>>> new_at;
    for (const auto& e : equations(after))
        if (const Vec3 p = place(after, e[0].node); p.x() == 1.5) new_at[e[0].dof].insert({p.x(), p.z()});
    EXPECT_EQ(new_at[1].size(), new_at[2].size());
    EXPECT_GE(new_at[1].size(), 5u);
    EXPECT_GE(new_at[3].size(), 1u);
    EXPECT_LT(new_at[3].size(), new_at[1].size());
}

TEST_F(RelatedNodesOfDeck, TermsThatAllShareStay) {
    // The side follows a reference node that no element has; each node's equation names it, and so do those of new ones
    // and copies.
    std::string cards = "*NODE\n900, 2., 2., 9.\n*EQUATION\n";
    for (int k = 0; k <= nz; ++k)
        for (int i = 0; i <= nx; ++i) cards += equal(node_at(i, ny, k), 900, 2);
    for (const double x : {1.5, 2.0}) {
        const Mesh after = crack_at(block_with(cards), x, "CRACK", Vec3(1, 0, .1), true);
        std::set<Index> held;
        for (const auto& e : equations(after)) {
            ASSERT_EQ(e.size(), 2u);
            EXPECT_EQ(e[1].node, 900);
            EXPECT_TRUE(held.insert(e[0].node).second);
        }
        EXPECT_EQ(held, nodes_where(after, [](const Vec3& p) { return p.y() == ny && p.z() <= nz; }));
    }
}

TEST_F(RelatedNodesOfDeck, LongEquationsKeepFourTermsALine) {
    std::string cards = "*NODE\n901, 2., 2., 9.\n902, 2., 2., 9.\n903, 2., 2., 9.\n*EQUATION\n";
    for (int k = 0; k <= nz; ++k)
        for (int i = 0; i <= nx; ++i)
            cards += "5\n" + std::to_string(node_at(i, ny, k)) + ", 1, 1., " + std::to_string(node_at(i, 0, k)) +
                     ", 1, -1., 901, 1, .5, 902, 1, .25\n903, 1, -2.\n";
    const Mesh mesh = block_with(cards), after = crack_at(mesh, 1.5, "CRACK", Vec3(1, 0, 0), true);
    EXPECT_GT(equations(after).size(), equations(mesh).size() + 8);
    for (const Row& r : rows(after, "EQUATION")) EXPECT_LE(r.size(), 12u);
    for (const auto& e : equations(after)) {
        ASSERT_EQ(e.size(), 5u);
        EXPECT_LT((place(after, e[0].node) - place(after, e[1].node) - Vec3(0, ny, 0)).norm(), 1e-12);
        EXPECT_EQ(e[3].node, 902);
        EXPECT_EQ(e[4].factor, -2);
    }
}

TEST_F(RelatedNodesOfDeck, SidesThatAreCutDifferentlyAreTold) {
    const Mesh mesh = block_with(periodic_in_y());
    const Vec3 oblique(1, .4, 0);  // meets the sides at different x
    const Mesh after = crack_at(mesh, 2, "CRACK", oblique);
    const std::string first =
        std::to_string(node_at(0, ny, 0)) + ", 1, 1., " + std::to_string(node_at(0, 0, 0)) + ", 1, -1.";
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr("*EQUATION: "), HasSubstr("new nodes ("),
                                          HasSubstr("no counterpart"), HasSubstr("deck.inp:"))));
    for (const auto& e : equations(after))
        EXPECT_LT((place(after, e[0].node) - place(after, e[1].node) - Vec3(0, ny, 0)).norm(), 1e-12);
    EXPECT_THROW(crack_at(mesh, 2, "CRACK", oblique, true), Error);
}

TEST_F(RelatedNodesOfDeck, EndsRelatedByDifferentEquationsAreTold) {
    std::string cards = "*EQUATION\n";
    for (int k = 0; k <= nz; ++k)
        for (int i = 0; i <= nx; ++i)
            cards += "2\n" + std::to_string(node_at(i, ny, k)) + ", 1, 1., " + std::to_string(node_at(i, 0, k)) +
                     ", 1, " + (i < 2 ? "-1.\n" : "-.5\n");
    const Mesh mesh = block_with(cards);
    crack_at(mesh, 1.5, "CRACK", Vec3(1, 0, 0));
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr("*EQUATION: "), HasSubstr("different form"))));
    EXPECT_THROW(crack_at(mesh, 1.5, "CRACK", Vec3(1, 0, 0), true), Error);
    // Away from where they change, nothing has to be told.
    crack_at(mesh, 2.5, "CRACK", Vec3(1, 0, 0), true);
}

TEST_F(RelatedNodesOfDeck, RefinementRelatesTooOrTells) {
    const Mesh mesh = block_with(periodic_in_y());
    RefineOptions options;
    options.size = .6;
    const Plane plane(Vec3(2, 1, 1), Vec3(1, 0, 0));
    const Mesh after = written(refine(mesh, distance_to({&plane}), options));
    std::set<Index> related;
    for (const auto& e : equations(after)) {
        EXPECT_LT((place(after, e[0].node) - place(after, e[1].node) - Vec3(0, ny, 0)).norm(), 1e-12);
        related.insert(e[0].node);
    }
    EXPECT_GT(related.size(), 20u);
    const bool all = related == nodes_where(after, [](const Vec3& p) { return p.y() == ny; });
    const bool told = testing::Matches(Contains(HasSubstr("no counterpart")))(warnings_);
    EXPECT_NE(all, told);
}

/// Two triangles side by side: nodes 1 2 3 and 4 5 6. Node 2 is born between; 4 to 6 move as 1 to 3 do.
struct RelateNewNodes : testing::Test {
    RelateNewNodes() {
        for (const Vec3& at :
             {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 5), Vec3(2, 0, 5), Vec3(0, 1, 5)})
            before.add_node(at, before.node_count() + 1);
        before.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 1);
        before.add_cell(CellType::triangle, std::array<Index, 3>{3, 4, 5}, 2);
        for (Index n = 1; n <= 3; ++n) equations.push_back({{{n + 3, 1, 1, "1, 1."}, {n, 1, -1, "1, -1."}}});
        after = before;
    }
    void bear(Index number, Index a, Index b, double share = 0.5) {
        after.add_node((1 - share) * before.points[a - 1] + share * before.points[b - 1], number);
        changes.born.push_back({number, {a, b}});
    }
    void copy(Index number, Index of) {
        after.add_node(before.points[of - 1], number);
        changes.copies.push_back({number, of});
    }
    RelatedNodes related() const {
        const NumberIndex numbers(before), now(after);
        const NodeOrigins origins(before, numbers, after, now, changes);
        return relate_new_nodes(equations, before, numbers, origins, changes);
    }
    Mesh before, after;
    Changes changes;
    std::vector<NodeEquation> equations;
};

TEST_F(RelateNewNodes, NodesBornAtOnePlaceAreRelated) {
    bear(7, 1, 2);
    bear(8, 4, 5);
    const RelatedNodes out = related();
    ASSERT_EQ(out.made.size(), 1u);
    EXPECT_THAT(out.made[0].nodes, ElementsAre(8, 7));
    EXPECT_TRUE(out.missed.empty());
}

TEST_F(RelateNewNodes, NodesBornElsewhereAreMissed) {
    bear(7, 1, 2);
    bear(8, 4, 5, 0.25);
    const RelatedNodes out = related();
    EXPECT_TRUE(out.made.empty());
    std::vector<Index> missed;
    for (const RelatedNodes::Missed& m : out.missed) missed.push_back(m.node);
    EXPECT_THAT(missed, testing::UnorderedElementsAre(7, 8));
}

TEST_F(RelateNewNodes, CopiesFollowWhereAllAreDoubled) {
    copy(7, 1);
    copy(8, 4);
    copy(9, 2);
    const RelatedNodes out = related();
    ASSERT_EQ(out.copies_follow.size(), 3u);
    EXPECT_TRUE(out.copies_follow[0]);
    EXPECT_FALSE(out.copies_follow[1]) << "node 5 is not doubled";
    ASSERT_EQ(out.made.size(), 1u);
    EXPECT_THAT(out.made[0].nodes, ElementsAre(8, 7));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
