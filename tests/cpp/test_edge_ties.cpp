// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/edge_ties.h"

#include "deck/supported_nodes.h"
#include "deck/turned_nodes.h"
#include "deck_testing.h"
#include "mesh/order.h"
#include "simple_meshes.h"

namespace femscalpel::deck_testing {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A pyramid with a tetrahedron on the side at the edge from (0, 0, 0) to (1, 0, 0).
Mesh pyramid_and_tetrahedron() {
    Mesh mesh;
    for (const Vec3& x :
         {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, 1), Vec3(0.5, -1, 0.5)})
        mesh.add_node(x, mesh.node_count() + 1);
    mesh.add_cell(CellType::pyramid, std::array<Index, 5>{0, 1, 2, 3, 4}, 1);
    mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 4, 5}, 2);
    return to_second_order(mesh);
}

class EdgeTiesOf : public DeckSemantics {
protected:
    std::string text_of_file(const Mesh& mesh) const {
        write_inp(mesh, folder_ / "out.inp");
        std::ifstream in(folder_ / "out.inp");
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

TEST_F(EdgeTiesOf, KeepEdgesStraightThatATetrahedronIsAcrossFrom) {
    Mesh mesh = pyramid_and_tetrahedron();
    const Index middle = mesh.node_ids[checks::number_near(mesh, {0.5, 0, 0})];
    const std::string ties = edge_ties(mesh).text, number = std::to_string(middle);
    EXPECT_EQ(std::ranges::count(ties, '\n'), 2 + 3 * 2);
    EXPECT_THAT(ties, HasSubstr("3\n" + number + ", 2, 1., 1, 2, -0.5, 2, 2, -0.5\n"));
    EXPECT_THAT(edge_ties(to_first_order(mesh)).text, IsEmpty());
    const std::string text = text_of_file(mesh);
    EXPECT_THAT(text, HasSubstr(ties));
    // Reading leaves them out, and comments behind them stay.
    const Mesh back = read(text + "** a comment\n*STEP\n*STATIC\n*END STEP\n");
    EXPECT_THAT(text_of(back, "EQUATION"), IsEmpty());
    const std::string again = text_of_file(back);
    EXPECT_THAT(again, HasSubstr("** a comment\n"));
    EXPECT_EQ(text_of_file(read(again)), again);
    mesh.block(CellType::tetra10) = {CellType::tetra10, {}, {}, {}};
    EXPECT_THAT(edge_ties(mesh).text, IsEmpty());
}

TEST_F(EdgeTiesOf, LeaveOutWhatIsSetOtherwise) {
    const Mesh mesh = pyramid_and_tetrahedron();
    const std::string number = std::to_string(mesh.node_ids[checks::number_near(mesh, {0.5, 0, 0})]),
                      text = text_of_file(mesh);
    const auto ties = [&](const std::string& cards) { return edge_ties(read(text + cards)).text; };
    EXPECT_THAT(ties("*BOUNDARY\n" + number + ", 2\n"), testing::Not(HasSubstr(number + ", 2, 1.")));
    EXPECT_THAT(ties("*BOUNDARY\n" + number + ", 2\n"), HasSubstr(number + ", 3, 1."));
    EXPECT_THAT(ties("*NSET, NSET=A\n" + number + "\n*BOUNDARY\nA, 1, 3\n"), IsEmpty());
    const std::string other = "*EQUATION\n2\n" + number + ", 1, 1., 6, 1, -1.\n2\n6, 2, 1., " + number + ", 2, -1.\n";
    EXPECT_THAT(ties(other), testing::Not(HasSubstr(number + ", 1, 1.")));
    EXPECT_THAT(ties(other), HasSubstr(number + ", 2, 1.")) << "independent there";
    const std::string surfaces = "*SURFACE, NAME=S\n1, S1\n*SURFACE, NAME=T\n2, S2\n";
    EXPECT_THAT(ties(surfaces + "*TIE, NAME=X\nS, T\n"), HasSubstr(number + ", 1, 1.")) << "follows its ends";
    EXPECT_THAT(ties(surfaces + "*TIE, NAME=X, CYCLIC SYMMETRY\nS, T\n"), IsEmpty());
    EXPECT_THAT(ties("*STEP\n*HEAT TRANSFER\n*END STEP\n"), HasSubstr(number + ", 11, 1."));
    EXPECT_THAT(ties("*STEP\n*HEAT TRANSFER\n*END STEP\n"), testing::Not(HasSubstr(number + ", 1, 1.")));
}

TEST_F(EdgeTiesOf, SupportsOfSomeStepsAreWrittenWithoutTheMiddle) {
    const Mesh mesh = pyramid_and_tetrahedron();
    const std::string number = std::to_string(mesh.node_ids[checks::number_near(mesh, {0.5, 0, 0})]);
    const std::string cards = "*NSET, NSET=A\n1, 2, 3, " + number +
                              "\n*STEP\n*STATIC\n*BOUNDARY\nA, 1, 3, 0.1\n1, 2\n2, 2\n" + number +
                              ", 2\n** a comment\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, OP=NEW\n3, 1\n*END STEP\n";
    const Mesh given = read(text_of_file(mesh) + cards);
    const std::string text = text_of_file(given);
    EXPECT_THAT(text, HasSubstr("\n3\n" + number + ", 2, 1., 1, 2, -0.5, 2, 2, -0.5\n"));
    EXPECT_THAT(text, HasSubstr("*NSET, NSET=A_NOT_TIED1\n** without the middles of straight edges\n1, 2, 3,\n"));
    EXPECT_THAT(text, HasSubstr("*BOUNDARY\n** without the middles of straight edges: A, 1, 3, 0.1\n"
                                "A_NOT_TIED1, 1, 3, 0.1\n1, 2\n2, 2\n"
                                "** left out, the middle of a straight edge: " +
                                number + ", 2\n** a comment\n"));
    const Mesh back = read(text);
    EXPECT_EQ(rows(back, "BOUNDARY"), rows(given, "BOUNDARY"));
    EXPECT_FALSE(back.find_group("A_NOT_TIED1"));
    EXPECT_EQ(text_of_file(back), text);
    // One that is held without the ends keeps its support.
    const Mesh alone = read(text_of_file(mesh) + "*STEP\n*STATIC\n*BOUNDARY\n" + number +
                            ", 2\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, OP=NEW\n3, 1\n*END STEP\n");
    EXPECT_TRUE(edge_ties(alone).supports.empty());
    EXPECT_THAT(edge_ties(alone).text, testing::Not(HasSubstr(number + ", 2, 1.")));
}

TEST_F(EdgeTiesOf, SupportedNodesBySteps) {
    const std::string text = text_of_file(pyramid_and_tetrahedron()) +
                             "*BOUNDARY\n1, 1, 2\n*STEP\n*STATIC\n*BOUNDARY\n2, 1\n3, 3\n*END STEP\n"
                             "*STEP\n*STATIC\n*BOUNDARY, OP=NEW\n1, 1\n4, 2\n*END STEP\n";
    const Mesh mesh = read(text);
    const DeckView deck(mesh);
    const SupportedNodes held(deck, {1, 2, 3});
    EXPECT_TRUE(held.is_always_held(1, 1)) << "given anew";
    EXPECT_TRUE(held.is_held(1, 2));
    EXPECT_FALSE(held.is_always_held(1, 2));
    EXPECT_TRUE(held.is_held_with(2, 1, 1));
    EXPECT_FALSE(held.is_held_with(1, 2, 1));
    EXPECT_FALSE(held.is_held(3, 1) || held.is_held(4, 2)) << "no node to look at";
}

TEST_F(EdgeTiesOf, TurnedNodesHaveTheAxesOfTheLastCard) {
    const std::string text = text_of_file(pyramid_and_tetrahedron()) + "*NSET, NSET=A\n1, 2\n*NSET, NSET=B\n2, 3\n" +
                             "*TRANSFORM, NSET=A\n0, 2, 0, 1, 1, 0\n*TRANSFORM, NSET=B, TYPE=C\n0, 0, 0, 0, 0, 3\n";
    const Mesh mesh = read(text);
    const TurnedNodes turned(mesh);
    EXPECT_FALSE(turned.contains(4));
    EXPECT_EQ(*turned.axes(4), Eigen::Matrix3d::Identity());
    Eigen::Matrix3d wanted;
    wanted << 0, 1, 0, 1, 0, 0, 0, 0, -1;
    EXPECT_TRUE(turned.axes(1)->isApprox(wanted));
    const double h = std::sqrt(0.5);
    wanted << h, -h, 0, h, h, 0, 0, 0, 1;
    EXPECT_TRUE(turned.axes(3)->isApprox(wanted)) << "in (1, 1, 0)";
    EXPECT_TRUE(turned.axes(2)->isApprox(Eigen::Matrix3d::Identity()));
    EXPECT_THAT(turned.where(3), HasSubstr(":"));
    EXPECT_FALSE(TurnedNodes(read(text + "*TRANSFORM, NSET=A\n0, 0, 0, 0, 1, 0\n")).axes(1));
    EXPECT_THAT(problems_of_ties(read(text + "*TRANSFORM, NSET=A\n0, 0, 0, 0, 1, 0\n")),
                testing::ElementsAre(HasSubstr("*TRANSFORM")));
}

}  // namespace
}  // namespace femscalpel::deck_testing
