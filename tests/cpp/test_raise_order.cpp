// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/raise_order.h"

#include "deck/edge_ties.h"
#include "deck/tied_edges.h"
#include "deck_testing.h"
#include "mesh/order.h"
#include "operators/crack.h"
#include "simple_meshes.h"
#include "tools/plane.h"

namespace femscalpel::deck_testing {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(ToSecondOrder, OfSomeElementsTellsTheEdgesThatOthersHave) {
    const Mesh mesh = checks::bricks(3, 1, 1);
    std::array<std::vector<char>, cell_type_count> first;
    for (const CellBlock& b : mesh.blocks()) first[static_cast<int>(b.type)].assign(b.ids.size(), 0);
    first[static_cast<int>(CellType::hexahedron)][0] = 1;
    const RaisedOrder out = to_second_order(mesh, first, 1000);
    EXPECT_EQ(out.mesh.block(CellType::hexahedron).size(), 2);
    ASSERT_EQ(out.mesh.block(CellType::hexahedron20).size(), 1);
    EXPECT_EQ(out.mesh.block(CellType::hexahedron20).ids[0], mesh.block(CellType::hexahedron).ids[0]);
    EXPECT_EQ(out.made.size(), 12u);
    EXPECT_EQ(out.made.front()[0], 1000);
    EXPECT_TRUE(edges_between_orders(out.mesh).empty()) << "without a deck that asks for it";
    Mesh tied = out.mesh;
    auto deck = std::make_shared<SolverInput>();
    deck->set_ties_orders(true);
    tied.companion = deck;
    const std::vector<TiedEdge> rim = edges_between_orders(tied);
    ASSERT_EQ(rim.size(), 4u);
    const NumberIndex numbers(out.mesh);
    for (const TiedEdge& e : rim) {
        const auto at = [&](Index number) { return out.mesh.points[*numbers.node(number)]; };
        EXPECT_EQ(at(e.middle), Vec3((at(e.a) + at(e.b)) / 2));
        EXPECT_EQ(at(e.middle).x(), 1);
    }
}

TEST(ToSecondOrder, OfAnEdgeWhoseEndsAreOneNodeIsThatNode) {
    Mesh mesh;
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)})
        mesh.add_node(x, mesh.node_count() + 1);
    mesh.add_cell(CellType::hexahedron, std::array<Index, 8>{0, 1, 2, 2, 3, 4, 5, 5}, 1);
    const Mesh second = to_second_order(mesh);
    EXPECT_EQ(second.node_count(), 6 + 9);
    const auto n = second.block(CellType::hexahedron20).nodes(0);
    EXPECT_EQ(n[10], 2) << "edge 2-3 of the lower face";
    EXPECT_EQ(n[14], 5) << "of the upper face";
    EXPECT_EQ(n[18], n[19]);
}

class RaiseOrder : public DeckSemantics {
protected:
    /// Hexahedra in a row, of a deck.
    Mesh row() {
        write_inp(checks::bricks(20, 2, 2), folder_ / "row.inp");
        std::ifstream in(folder_ / "row.inp");
        return read(std::string(std::istreambuf_iterator<char>(in), {}) + "*STEP\n*STATIC\n*END STEP\n");
    }
};

TEST_F(RaiseOrder, TakesWhatWasConvertedAndARing) {
    const Mesh mesh = row();
    CrackOptions options;
    const Plane plane({10.4, 1, 1}, {1, 0.1, 0});
    const Result linear = crack(mesh, plane, options);
    options.second_order = true;
    const Result raised = crack(mesh, plane, options);
    EXPECT_EQ(raised.mesh.block(CellType::tetra10).size(), linear.mesh.block(CellType::tetra).size());
    EXPECT_EQ(raised.mesh.block(CellType::pyramid13).size(), linear.mesh.block(CellType::pyramid).size());
    EXPECT_EQ(raised.mesh.block(CellType::hexahedron20).size(), 8) << "four on either side";
    EXPECT_GT(raised.mesh.block(CellType::hexahedron).size(), 0);
    EXPECT_EQ(raised.mesh.block(CellType::triangle6).size(), linear.mesh.block(CellType::triangle).size());
    EXPECT_THAT(text_of(raised.mesh, "EQUATION"), IsEmpty()) << "made where the deck is written";
    EXPECT_THAT(edge_ties(raised.mesh).text, HasSubstr("straight edges between elements of second and of first"));
    EXPECT_THAT(linear.report.warnings, testing::Contains(HasSubstr("stiffer")));
    EXPECT_THAT(raised.report.warnings, IsEmpty());
    options.band_only = true;
    EXPECT_EQ(crack(mesh, plane, options).mesh.block(CellType::tetra10).size(), 0);
}

}  // namespace
}  // namespace femscalpel::deck_testing
