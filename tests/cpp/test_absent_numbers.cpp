// SPDX-License-Identifier: LGPL-2.1-or-later
// Numbers that cards name and nobody has: told when the deck is read, and never given to what is new.
#include "deck/rules/absent_numbers.h"

#include "cutting/numbering.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::AllOf;
using testing::Contains;
using testing::EndsWith;
using testing::HasSubstr;

class AbsentNumbersOfDecks : public RuleTest {
protected:
    AbsentNumbers absent(const std::string& cards) const {
        mesh_ = two_tetras(cards);
        return {mesh_, *solver_input(mesh_)};
    }
    /// The deck in the folder names them still: not read back, as crack_at() does.
    Mesh cracked(const Mesh& mesh, double x, const std::string& name, bool strict = false) {
        CrackOptions options;
        options.name = name;
        options.strict = strict;
        const Result result = crack(mesh, Plane(Vec3(x, 1, 1), Vec3(1, 0, 0)), options);
        warnings_ = result.report.warnings;
        return result.mesh;
    }
    mutable Mesh mesh_;
};

TEST_F(AbsentNumbersOfDecks, AreFoundInEveryCardThatNamesByNumber) {
    struct Case {
        const char* cards;
        Index node, element;
    };
    for (const auto& [cards, node, element] : {
             Case{"*BOUNDARY\n90, 1, 3\n", 90, 0},
             Case{"*CLOAD\nNALL, 3, 70.\n90, 3, 80.\n", 90, 0},
             Case{"*CFLUX\n90, 11, 5.\n", 90, 0},
             Case{"*RETAINED NODAL DOFS\n90, 1, 3\n", 90, 0},
             Case{"*DISTRIBUTING COUPLING, ELSET=EALL\n90, 1.\n", 90, 0},
             Case{"*TEMPERATURE\n90, 50.\n", 90, 0},
             Case{"*NODAL THICKNESS\n90, 50.\n", 90, 0},
             Case{"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n90, 50.\n", 90, 0},
             Case{"*INITIAL CONDITIONS, TYPE=VELOCITY\n90, 1, 50.\n", 90, 0},
             Case{"*INITIAL CONDITIONS, TYPE=STRESS\n8, 1, 100., 0., 0., 0., 0., 0.\n", 0, 8},
             Case{"*DEPVAR\n8\n*INITIAL CONDITIONS, TYPE=SOLUTION\n8, 1, 1., 2., 3., 4., 5., 6.\n70., 80.\n", 0, 8},
             Case{"*DISTRIBUTION, NAME=D\n, 1., 0., 0., 0., 1., 0.\n8, 1., 0., 0., 0., 1., 0.\n", 0, 8},
             Case{"*SUBMODEL, TYPE=NODE, INPUT=a.frd\n90,\n", 90, 0},
             Case{"*SUBMODEL, TYPE=SURFACE, INPUT=a.frd\n90\n", 0, 0},
             Case{"*DLOAD\nEALL, P1, 70.\n8, P1, 80.\n", 0, 8},
             Case{"*DFLUX\n8, S1, 80.\n", 0, 8},
             Case{"*FILM\n1, F1FC, 90, 10.\n", 90, 0},
             Case{"*DLOAD\nEALL, P1NP, 90\n", 90, 0},
             Case{"*FILM\n1, F1, 90., 10.\n", 0, 0},
             Case{"*RADIATE\n8, R1, 90., 0.5\n", 0, 8},
             Case{"*BOUNDARYF\n8, S1, 1, 1, 90.\n", 0, 8},
             Case{"*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n1, 8\n", 0, 8},
             Case{"*NORMAL\n8, 90, 0., 0., 1.\n", 90, 8},
             Case{"*EQUATION\n2\n1, 2, 90., 90,\n 2, -70.\n", 90, 0},
             Case{"*EQUATION\n2\n1, 2, 1., 2, 2, -1.\n3\n1, 1, 1., 2, 1, 1.\n90, 1, -70.\n", 90, 0},
             Case{"*EQUATION, REMOVE\n90, 1\n", 90, 0},
             Case{"*NETWORK MPC, TYPE=A\n2\n1, 2, 1., 90, 2, -1.\n", 90, 0},
             Case{"*EQUATIONF\n2\n1, S1, 1, 70., 8, S1, 1, 80.\n", 0, 8},
             Case{"*MPC\nPLANE, 1, 2, 3, 90\n", 90, 0},
             Case{"*RIGID BODY, NSET=NALL, REF NODE=80, ROT NODE=90\n", 90, 0},
             Case{"*COUPLING, REF NODE=90, SURFACE=S, CONSTRAINT NAME=C\n", 90, 0},
             Case{"*PRE-TENSION SECTION, ELEMENT=8, NODE=90\n1., 0., 0.\n", 90, 8},
             Case{"*NODE PRINT, NSET=NALL\nU\n*STATIC\n70, 80.\n", 0, 0},
             Case{"*BOUNDARY\n0, 1, 3\n-7, 1\n3000000000, 1\n", 0, 0},  // what no node can have
         }) {
        const AbsentNumbers found = absent(cards);
        EXPECT_EQ(found.largest_node(), node) << cards;
        EXPECT_EQ(found.largest_element(), element) << cards;
        EXPECT_EQ(next_numbers(mesh_).node, std::max<Index>(node, 5) + 1) << cards;
        EXPECT_EQ(next_numbers(mesh_).cell, std::max<Index>(element, 2) + 1) << cards;
        EXPECT_EQ(solver_input(mesh_)->warnings().empty(), node == 0 && element == 0) << cards;
    }
}

TEST_F(AbsentNumbersOfDecks, AreToldByLine) {
    const AbsentNumbers found = absent("*BOUNDARY\n1, 1, 3\n90, 1\n91, 2\n90, 3\n*NORMAL\n8, 92, 0., 0., 1.\n");
    ASSERT_EQ(found.all().size(), 3u);
    EXPECT_THAT(found.all()[0].numbers, ElementsAre(90, 91, 90));
    EXPECT_EQ(named_text(found.all()[0], solver_input(mesh_)->cards()[found.all()[0].card]),
              "*BOUNDARY names node 90 and 1 more");
    EXPECT_THAT(
        solver_input(mesh_)->warnings(),
        ElementsAre(EndsWith("deck.inp:12: *BOUNDARY names node 90 and 1 more that the deck does not define; kept as "
                             "it is, correct the line"),
                    HasSubstr("deck.inp:16: *NORMAL names element 8 that"),
                    HasSubstr("deck.inp:16: *NORMAL names node 92 that")));
}

TEST_F(AbsentNumbersOfDecks, AreNotThoseOfElementsBesideTheMesh) {
    EXPECT_EQ(absent("*USER ELEMENT, TYPE=U1, NODES=2, INTEGRATION POINTS=1, MAXDOF=3\n*ELEMENT, TYPE=U1\n7, 1, 2\n"
                     "*DLOAD\n7, GRAV, 1., 0., 0., 1.\n")
                  .largest_element(),
              0);
}

TEST_F(AbsentNumbersOfDecks, AreGivenToNobody) {
    const std::string line = "90, 1, 3";
    const Mesh mesh = block_with("*BOUNDARY\n" + line + "\n*DLOAD\n97, P1, 3.\n");
    const Mesh once = cracked(mesh, 1.5, "CRACK");
    EXPECT_FALSE(NumberIndex(once).node(90));
    EXPECT_FALSE(NumberIndex(once).cell(97));
    EXPECT_GT(once.node_count(), 45);
    const Mesh twice = cracked(once, 2.5, "AGAIN");
    EXPECT_FALSE(NumberIndex(twice).node(90));
    EXPECT_FALSE(NumberIndex(twice).cell(97));
}

TEST_F(AbsentNumbersOfDecks, ThatCalculixNoLongerRefusesAreAProblem) {
    const std::string line = "90, 1, 3";
    const Mesh mesh = block_with("*BOUNDARY\n" + line + "\n");
    const Mesh once = cracked(mesh, 1.5, "CRACK");
    const auto told = AllOf(HasSubstr(at_line(line)), HasSubstr("*BOUNDARY names node 90 that the deck does not"),
                            HasSubstr("CalculiX refused that, and passes over it now"));
    EXPECT_THAT(warnings_, Contains(told));
    EXPECT_THROW(cracked(mesh, 1.5, "CRACK", true), Error);
    cracked(once, 2.5, "AGAIN");
    EXPECT_THAT(warnings_, testing::Not(Contains(told))) << "CalculiX passed over it before";
}

TEST_F(AbsentNumbersOfDecks, AreThoseOfWhatWasRemovedToo) {
    const Carried after = carried("*NETWORK MPC, TYPE=A\n2\n1, 2, 1., 5, 2, -1.\n*MPC\nBEAM, 1, 5\n", remove_element_2);
    EXPECT_EQ(next_numbers(after.mesh).node, 6) << "the *MPC card names node 5 still";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
