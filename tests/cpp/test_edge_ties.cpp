// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/edge_ties.h"

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
    EXPECT_THAT(ties("*EQUATION\n2\n" + number + ", 1, 1., 6, 1, -1.\n"), IsEmpty());
    EXPECT_THAT(ties("*SURFACE, NAME=S\n1, S1\n*SURFACE, NAME=T\n2, S2\n*TIE, NAME=X\nS, T\n"), IsEmpty());
    EXPECT_THAT(ties("*STEP\n*HEAT TRANSFER\n*END STEP\n"), HasSubstr(number + ", 11, 1."));
    EXPECT_THAT(ties("*STEP\n*HEAT TRANSFER\n*END STEP\n"), testing::Not(HasSubstr(number + ", 1, 1.")));
}

}  // namespace
}  // namespace femscalpel::deck_testing
