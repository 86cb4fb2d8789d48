// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/gone_sets.h"

#include "io/io.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::EndsWith;
using testing::HasSubstr;

class GoneSetsOfDecks : public RuleTest {
protected:
    /// What is told once groups of these names are taken out.
    std::vector<std::string> told(const std::string& cards, const std::vector<std::string>& names) const {
        Mesh mesh = two_tetras(cards);
        for (const std::string& name : names)
            while (const auto group = mesh.find_group(name)) remove_group(mesh, *group);
        EXPECT_EQ(loose_ends(mesh, "out.inp"), named_gone_sets(mesh));
        EXPECT_THAT(loose_ends(mesh, "out.med"), IsEmpty());
        return named_gone_sets(mesh);
    }
};

TEST_F(GoneSetsOfDecks, AreToldWithTheirCards) {
    const std::string cards =
        "*NSET, NSET=A\n1, 2\n*ELSET, ELSET=B\n1\n*SURFACE, NAME=S\n1, S1\n*HEADING\nA\n*BOUNDARY\nNALL, 1\na, 2, 3\n"
        "*CLOAD\nA, 1, 5.\n*NODE PRINT, NSET=A\nU\n*EQUATION\n2\n1, 2, 1., A, 2, -1.\n*DLOAD\nB, P1, 1.\n"
        "*SOLID SECTION, ELSET=B, MATERIAL=M\n*DSLOAD\nS, P, 1.\n*TIE, NAME=T\nS, S\n*SECTION PRINT, SURFACE=S\nSOF\n";
    EXPECT_THAT(told(cards, {}), IsEmpty());
    EXPECT_THAT(told(cards, {"A"}),
                ElementsAre(testing::AllOf(
                    HasSubstr("node set 'A' is not in the mesh any more, but "),
                    EndsWith("deck.inp:20 (*BOUNDARY) and 3 more name it: CalculiX will stop there. Take what names it "
                             "out of the deck, or put the group back"))));
    EXPECT_THAT(told(cards, {"B", "S"}), ElementsAre(HasSubstr("deck.inp:29 (*DLOAD) and 1 more name it"),
                                                     HasSubstr("element surface 'S' is not in the mesh any more")));
}

TEST_F(GoneSetsOfDecks, AreNothingWhereNobodyNamesThem) {
    EXPECT_THAT(told("*NSET, NSET=A\n1, 2\n*NSET, NSET=C\nA, 3\n*BOUNDARY\nC, 1\n", {"A"}), IsEmpty());
    EXPECT_THAT(named_gone_sets(Mesh()), IsEmpty());
}

TEST_F(GoneSetsOfDecks, AreNotOthersOfThatName) {
    Mesh mesh = two_tetras("*NSET, NSET=A\n1, 2\n*ELSET, ELSET=A\n1\n*BOUNDARY\nA, 1\n*NODE PRINT, NSET=A\nU\n");
    remove_group(mesh, *mesh.find_group("A", GroupKind::element));
    EXPECT_THAT(named_gone_sets(mesh), IsEmpty());
    remove_group(mesh, *mesh.find_group("A", GroupKind::node));
    EXPECT_EQ(named_gone_sets(mesh).size(), 2u);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
