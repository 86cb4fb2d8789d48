// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/rules.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;

class NamelessCardsRule : public RuleTest {};

TEST(CardContents, EveryCardOfCalculixsDecksIsKnown) {
    const fs::path decks = "/usr/share/doc/calculix-ccx-test/examples/test";
    if (!fs::exists(decks)) GTEST_SKIP() << "Debian package calculix-ccx-test is not installed";
    const CardRules rules;
    std::set<std::string> unknown;
    for (const auto& entry : fs::directory_iterator(decks)) {
        const std::string name = entry.path().filename();
        if (!name.ends_with(".inp") && !name.ends_with(".inp.gz")) continue;
        if (entry.file_size() > 100000) continue;
        Mesh mesh;
        try {
            mesh = read_inp(entry.path());
        } catch (const Error&) {
            continue;
        }
        for (const Card& card : solver_input(mesh)->cards())
            if (!rules.find(card)) unknown.insert(card.keyword + " in " + name);
    }
    // CalculiX does not know the first either; the others come with version 2.22.
    const std::set<std::string> expected = {"MEMBRANE in c3d6.inp",
                                            "ENDASSEMBLY in lin_stat_initial_temp_condition.inp",
                                            "ENDASSEMBLY in lin_stat_th_gradient.inp",
                                            "MATRIXASSEMBLE in beamfsuper.inp",
                                            "MATRIXASSEMBLE in beampsuper.inp",
                                            "MATRIXASSEMBLE in beampsuper2.inp",
                                            "MATRIXASSEMBLE in segmentsuper.inp",
                                            "PART in lin_stat_twisted_beam.inp",
                                            "RATEDEPENDENT in beam8pjc.inp"};
    EXPECT_THAT(unknown, testing::IsSubsetOf(expected));
    EXPECT_THAT(unknown, testing::Contains("MEMBRANE in c3d6.inp"));
}

TEST_F(NamelessCardsRule, AreKnownByTheirFirstLetters) {
    const CardRules rules;
    for (const auto& [text, known] : {std::pair("*STATIC\n", true),
                                      {"*FLUID SECTIONS, ELSET=A\n", true},
                                      {"*RATE DEPENDENT, TYPE=JOHNSON COOK\n", true},
                                      {"*MATRIX ASSEMBLE\n", true},
                                      {"*PART, NAME=A\n", true},
                                      {"*END ASSEMBLY\n", true},
                                      {"*STATI\n", false},
                                      {"*MEMBRANE\n", false}}) {
        Card card;
        card.set_text(text);
        CardRule* const rule = rules.find(card);
        EXPECT_EQ(rule != nullptr, known) << text;
        if (rule) {
            EXPECT_FALSE(rule->can_change(card)) << text;
        }
    }
}

TEST_F(NamelessCardsRule, SetsWithoutMembersAreTold) {
    const std::string cards =
        "*ELSET, ELSET=E\n2\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*DSLOAD\nE, P, 1.\n*CLOAD\n1, 1, 1.\n";
    const Carried after = carried(cards, remove_element_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:12: *SOLIDSECTION names element set 'E', which lost all its members",
                            "deck.inp:14: *DSLOAD names element set 'E', which lost all its members"));
}

TEST_F(NamelessCardsRule, SetsWithoutMembersAreToldInDecksWithNothingElseToo) {
    const std::string cards = "*ELSET, ELSET=E\n2\n*SOLID SECTION, ELSET=E, MATERIAL=M\n";
    EXPECT_THAT(carried(cards, double_node_2).warnings, IsEmpty());
    const Carried after = carried(cards, remove_element_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:12: *SOLIDSECTION names element set 'E', which lost all its members"));
}

TEST_F(NamelessCardsRule, CardsThatCalculixDoesNotHaveAreToldOnce) {
    const std::string cards = "*NOTACARD\n2, 1\n*NOTACARD\n3, 1\n";
    const Carried after = carried(cards, double_node_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:10: *NOTACARD is not a card of CalculiX up to 2.23: whether it names nodes or "
                            "elements is not known, so it is kept as it is; check it"));
}

TEST_F(NamelessCardsRule, CardsThatNameNothingAreNoProblem) {
    const std::string cards = "*NOTACARD, TYPE=3\n2., EALL, 77\n*NOTACARD, NODE=77\n";
    const Mesh mesh = two_tetras(cards);
    Mesh after = mesh;
    Changes changes;
    double_node_2(after, changes);
    EXPECT_THAT(
        warnings_of(carry_deck(mesh, after, changes), true),  // strict
        ElementsAre(testing::EndsWith("deck.inp:10: *NOTACARD is not a card of CalculiX up to 2.23: it names no "
                                      "node or element by number and is kept as it is")));
}

TEST_F(NamelessCardsRule, CardsThatNameNothingHideNoneThatDo) {
    for (const std::string line : {"*NOTACARD\n1., 2\n", "*NOTACARD, REF NODE=3\n"})
        EXPECT_THAT(carried("*NOTACARD\n0.5\n" + line, double_node_2).warnings,
                    UnorderedElementsAre(testing::HasSubstr("deck.inp:12: *NOTACARD is not a card"),
                                         testing::HasSubstr("deck.inp:10: *NOTACARD is not a card")))
            << line;
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
