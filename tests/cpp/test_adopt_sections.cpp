// SPDX-License-Identifier: LGPL-2.1-or-later
// What of an addition's deck is taken over.
#include "deck/adopt_sections.h"

#include <gtest/gtest.h>

#include "deck/solver_input.h"
#include "deck_testing.h"
#include "operators/unite.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// A cube whose deck has an element set of all elements, and these cards.
Mesh with_deck(const char* set, const std::vector<std::string>& cards) {
    Mesh mesh = checks::grid(1, 1, 1);
    const FamilyIndex all = checks::family_of(mesh, set, GroupKind::element);
    for (FamilyIndex& f : mesh.block(CellType::tetra).families) f = all;
    auto deck = std::make_shared<SolverInput>();
    deck->cards().emplace_back().set_text("*NODE\n");
    for (const std::string& text : cards) deck->cards().emplace_back().set_text(text);
    DeckSet elset;
    elset.type = DeckSetType::elset;
    elset.name = elset.group = set;
    deck->sets().push_back(elset);
    mesh.companion = deck;
    return mesh;
}

std::string text_of(const Mesh& mesh) {
    std::string out;
    for (const Card& card : solver_input(mesh)->cards())
        for (const DeckText& piece : card.text) out += piece.text;
    return out;
}

const std::vector<Index> apart(8, -1);

TEST(AdoptSections, LeavesOutAllElse) {
    Mesh addition = with_deck("A", {"*MATERIAL, NAME=M\n", "*ELASTIC\n1, 0\n", "*SOLID SECTION, ELSET=A, MATERIAL=M\n",
                                    "*EXPANSION\n1e-5\n", "*BOUNDARY\n1, 1\n", "*STEP\n", "*MATERIAL, NAME=X\n"});
    const Mesh mesh = with_deck("B", {});
    const auto warnings = reduce_to_sections(mesh, addition);
    // An *EXPANSION that is no material's is nothing to take.
    EXPECT_EQ(text_of(addition), "*NODE\n*MATERIAL, NAME=M\n*ELASTIC\n1, 0\n*SOLID SECTION, ELSET=A, MATERIAL=M\n");
    EXPECT_THAT(warnings, testing::ElementsAre(testing::AllOf(
                              testing::HasSubstr("*EXPANSION"), testing::HasSubstr("*BOUNDARY"),
                              testing::HasSubstr("*STEP"), testing::Not(testing::HasSubstr("*ELASTIC")))));
    EXPECT_TRUE(reduce_to_sections(mesh, addition).empty());
    EXPECT_EQ(reduce_to_sections(checks::grid(1, 1, 1), addition).size(), 1u);
    EXPECT_FALSE(addition.companion);
}

TEST(AdoptSections, GivesOtherNamesWhereTheyClash) {
    Mesh mesh = with_deck("All", {"*MATERIAL, NAME=M\n", "*ELASTIC\n1, 0\n", "*ORIENTATION, NAME=O\n1,0,0,0,1,0\n",
                                  "*SOLID SECTION, ELSET=All, MATERIAL=M\n", "*STEP\n"});
    const Mesh addition =
        with_deck("ALL", {"*ORIENTATION, NAME=o\n1, 0, 0, 0, 1, 0\n", "*MATERIAL, NAME=m\n", "*ELASTIC\n2, 0\n",
                          "*SOLID SECTION, ELSET=ALL, MATERIAL=m, ORIENTATION=o\n0.5\n"});
    unite(mesh, addition, apart, "", {"X_", true});
    EXPECT_EQ(checks::members(mesh, "All", GroupKind::element).size(), 6u);
    EXPECT_EQ(checks::members(mesh, "X_ALL", GroupKind::element).size(), 6u);
    const std::string text = text_of(mesh);
    EXPECT_THAT(text, testing::HasSubstr("*ELSET, ELSET=X_ALL\n*MATERIAL, NAME=X_m\n*ELASTIC\n2, 0\n"
                                         "*SOLID SECTION, ELSET=X_ALL, MATERIAL=X_m, ORIENTATION=o\n0.5\n*STEP\n"));
    // Both orientations say the same.
    EXPECT_EQ(text.find("X_o"), text.npos);
    EXPECT_THROW(unite(mesh, addition, apart, "", {"X_", true}), ToolError);
}

TEST(AdoptSections, RenamesOnlyWhatSectionsName) {
    const Mesh mesh = with_deck("A", {});
    Mesh plain = with_deck("A", {}), own = with_deck("A", {"*SOLID SECTION, ELSET=A, MATERIAL=M\n"});
    rename_section_groups(mesh, plain, "X_");
    rename_section_groups(mesh, own, "X_");
    EXPECT_TRUE(plain.find_group("A"));
    EXPECT_TRUE(own.find_group("X_A"));
    EXPECT_FALSE(own.find_group("A"));
}

TEST(AdoptSections, OfNothingIsNothing) {
    Mesh mesh = with_deck("B", {});
    const auto before = mesh.companion;
    adopt_sections(mesh, checks::grid(1, 1, 1), {}, "X_");
    EXPECT_EQ(mesh.companion, before);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
