// SPDX-License-Identifier: LGPL-2.1-or-later
// Which cards are whose; what becomes of whole decks is tested in Python.
#include "io/abaqus_cards.h"

#include "deck_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Card> cards_of(std::initializer_list<const char*> texts) {
    std::vector<Card> out;
    for (const char* text : texts) out.emplace_back().set_text(text);
    return out;
}

std::string refusal(std::initializer_list<const char*> texts) {
    try {
        refuse_generated_mesh(cards_of(texts));
    } catch (const ReadError& error) {
        return error.what();
    }
    return "";
}

TEST(AbaqusCards, DataInFilesIsThatOfMeshAndLoads) {
    EXPECT_TRUE(has_data_in_file("NODE"));
    EXPECT_TRUE(has_data_in_file("CLOAD"));
    EXPECT_FALSE(has_data_in_file("SUBMODEL")) << "that is a file of results";
    EXPECT_FALSE(has_data_in_file("INCLUDE"));
}

TEST(AbaqusCards, GenerateMayBeCutShort) {
    EXPECT_TRUE(is_short_generate("GEN"));
    EXPECT_TRUE(is_short_generate("GENERAT"));
    EXPECT_FALSE(is_short_generate("GENERATE"));
    EXPECT_FALSE(is_short_generate("GE"));
    EXPECT_FALSE(is_short_generate("GENIUS"));
}

TEST(AbaqusCards, WhatIsOfInstancesIsNotRefusedThere) {
    EXPECT_THAT(refusal({"*SYSTEM\n1., 0., 0.\n"}), HasSubstr("*SYSTEM: Abaqus takes the coordinates that follow"));
    EXPECT_EQ(refusal({"*SYSTEM\n1., 0., 0.\n", "*INSTANCE, NAME=A, PART=P\n"}), "");
    EXPECT_EQ(refusal({"*SYSTEM\n"}), "") << "the global one";
    EXPECT_EQ(refusal({"*NODE, SYSTEM=R\n1, 0., 0.\n"}), "");
    EXPECT_THAT(refusal({"*NGEN\n1, 9, 1\n", "*INSTANCE, NAME=A, PART=P\n"}), HasSubstr("*NGEN makes nodes between"));
}

TEST(AbaqusCards, NewerCardsAreToldOnce) {
    SolverInput input;
    input.cards() = cards_of({"*STATIC\n", "*MOHR COULOMB HARDENING\n1.\n", "*RATE DEPENDENT\n", "*RATE DEPENDENT\n"});
    warn_of_newer_cards(input);
    EXPECT_THAT(input.warnings(),
                ElementsAre(HasSubstr("*MOHRCOULOMBHARDENING is a card of CalculiX 2.21"),
                            HasSubstr("*RATEDEPENDENT is a card of CalculiX 2.21 and later; earlier ones pass over")));
}

TEST(AbaqusCards, IdleConstraintsAreTold) {
    SolverInput input;
    input.cards() = cards_of({"*KINEMATIC\n1, 3\n", "*KINEMATIC\n", "*RIGID BODY, NSET=A, REF NODE=1\n",
                              "*RIGID BODY, PIN NSET=A, REF NODE=1\n"});
    warn_of_idle_constraints(input);
    EXPECT_THAT(input.warnings(),
                ElementsAre(HasSubstr("*KINEMATIC without a line"), HasSubstr("*RIGID BODY without")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
