// SPDX-License-Identifier: LGPL-2.1-or-later
// Decks of parts: placed, renumbered, their lines changed one by one. What whole decks become is tested in Python.
#include "io/flatten_parts.h"

#include "deck_testing.h"
#include "io/flat_cards.h"
#include "io/flat_lines.h"
#include "io/flat_names.h"
#include "io/flat_to_calculix.h"
#include "io/instance_placement.h"
#include "io/part_deck.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using testing::ElementsAre;
using testing::HasSubstr;

Card card_of(const std::string& text) {
    Card card;
    card.set_text(text);
    card.text.front().file = std::make_shared<const DeckFile>(DeckFile{"deck.inp", text});
    card.text.front().text = card.text.front().file->text;
    return card;
}

std::string text_of(const Card& card) {
    std::string out;
    for (const DeckText& t : card.text) out += t.text;
    return out;
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-14) { EXPECT_LE((a - b).norm(), tolerance) << a; }

TEST(InstancePlacement, TranslatesThenTurns) {
    const Placement p = placement_of_instance(card_of("*INSTANCE\n1., 2., 3.\n1., 0., 0., 1., 0., 5., 90.\n"));
    EXPECT_TRUE(p.turns && p.moves);
    EXPECT_EQ(p.point(Vec3(0, 0, 0)), Vec3(-1, 0, 3)) << "quarter turns are exact";
    EXPECT_EQ(p.direction(Vec3(1, 0, 0)), Vec3(0, 1, 0));
    const Placement third = placement_of_instance(card_of("*INSTANCE\n0.\n0., 0., 0., 2., 2., 2., 120.\n"));
    expect_near(third.point(Vec3(1, 2, 3)), Vec3(3, 1, 2));
    const Placement only_turned = placement_of_instance(card_of("*INSTANCE\n\n0., 0., 0., 0., 0., 1., -90.\n"));
    EXPECT_EQ(only_turned.point(Vec3(1, 0, 0)), Vec3(0, -1, 0));
}

TEST(InstancePlacement, WithoutLinesOrByNothingIsNone) {
    for (const char* text :
         {"*INSTANCE\n", "*INSTANCE\n0., 0., 0.\n", "*INSTANCE\n0.\n0., 0., 0., 0., 0., 1., 360.\n"}) {
        const Placement p = placement_of_instance(card_of(text));
        EXPECT_FALSE(p.moves || p.turns) << text;
    }
}

TEST(InstancePlacement, OfSystemsIsTheirOriginAndAxes) {
    const Placement p = placement_of_system(card_of("*SYSTEM\n1., 0., 0., 1., 0., 3.\n1., 2., 0.\n"));
    expect_near(p.point(Vec3(1, 0, 0)), Vec3(1, 0, 1));
    expect_near(p.point(Vec3(0, 1, 0)), Vec3(1, 1, 0));
    expect_near(p.point(Vec3(0, 0, 1)), Vec3(0, 0, 0));
    EXPECT_THROW(placement_of_system(card_of("*SYSTEM\n1., 0., 0., 1., 0., 0.\n")), ReadError);
    const Placement moved = placement_of_instance(card_of("*INSTANCE\n10.\n0., 0., 0., 0., 0., 1., 90.\n"));
    expect_near(moved.after(p).point(Vec3(1, 0, 0)), moved.point(p.point(Vec3(1, 0, 0))));
}

TEST(FlatLines, ChangeFieldByFieldAndKeepTheRest) {
    Card card = card_of("*NSET, NSET=A\n  1, 2,  3,\n** why\n\n4\r\n5,6");
    std::vector<std::string> places;
    change_lines(card, [&](LineFields& line, std::size_t number, const Where& where) {
        places.push_back(where());
        if (number == 0) line.put(2, "33");
        if (number == 1) line.put(0, "44");
        if (number == 2) line.put(3, "88");
    });
    EXPECT_EQ(text_of(card), "*NSET, NSET=A\n  1, 2,  33,\n** why\n\n44\r\n5,6, , 88");
    EXPECT_THAT(places, ElementsAre("deck.inp:2: ", "deck.inp:5: ", "deck.inp:6: "));
}

TEST(FlatLines, TextThatStaysIsNotCopied) {
    Card card = card_of("*NSET, NSET=A\n1\n");
    const auto* file = card.text.front().file.get();
    change_lines(card, [](LineFields&, std::size_t, const Where&) {});
    EXPECT_EQ(card.text.back().file.get(), file);
    change_lines(card, [](LineFields& line, std::size_t, const Where&) { line.cut(0); });
    EXPECT_NE(card.text.back().file.get(), file);
}

TEST(FlatLines, KeywordLinesKeepTheirNumber) {
    Card card = card_of("*RIGID BODY,\n REF NODE=A,\n NSET=B\n7\n");
    card.head = card.text.front().text.find('7');  // as read_cards() has it
    change_parameters(card, {{"REFNODE", "12"}});
    EXPECT_EQ(text_of(card), "*RIGID BODY, REF NODE=12\n**\n**\n7\n");
    EXPECT_EQ(*card.parameter("REFNODE"), "12");
    CardReader line(card);
    ASSERT_TRUE(line.next_data_line());
    EXPECT_EQ(line.where(), "deck.inp:4: ");
}

TEST(ElementLinesOfACard, TellNumbersOfElementsFromThoseOfNodes) {
    const auto kinds = [](const std::string& type, const std::string& lines) {
        const Card card = card_of("*ELEMENT, TYPE=" + type + "\n" + lines);
        ElementLines element(card);
        std::string out;
        CardReader line(card);
        while (line.next_data_line()) {
            element.start_line();
            for (Index n = 0; !line.at_end(); line.integer(n)) {
                const auto what = element.next();
                out += !what ? '-' : *what == Numbered::element ? 'E' : 'n';
            }
            element.end_line(line.ends_with_comma());
        }
        return out;
    };
    EXPECT_EQ(kinds("S3", "1,2,3,4\n2,3,\n4,5\n"), "EnnnEnnn");
    EXPECT_EQ(kinds("S3", "1,2,3,4,5\n2,3\n4,5\n"), "Ennn-Ennn");
    EXPECT_EQ(kinds("U7", "1,2,3,\n4,5\n2,3,4\n"), "EnnnnEnn");
}

TEST(PartDeckOfCards, HasInstancesWithTheCardsOfTheirParts) {
    const std::vector<Card> cards{card_of("*INSTANCE, NAME=I, PART=P\n"),
                                  card_of("*NSET, NSET=\"a b\"\n"),
                                  card_of("*END INSTANCE\n"),
                                  card_of("*PART, NAME=p\n"),
                                  card_of("*NODE\n5, 1.\n7, 2.\n"),
                                  card_of("*END PART\n"),
                                  card_of("*STEP\n")};
    const PartDeck deck = take_parts_apart(cards);
    ASSERT_EQ(deck.instances.size(), 1u);
    EXPECT_THAT(deck.instances[0].cards, ElementsAre(&cards[4], &cards[1])) << "the part's, then its own";
    ASSERT_EQ(deck.items.size(), 5u);
    EXPECT_EQ(deck.items[0].instance, 0u);
    EXPECT_TRUE(deck.items[1].is_bracket && !deck.items[4].is_bracket);
    const FlatNames names(deck);
    EXPECT_EQ(names.instance(0).nodes.first, 5);
    EXPECT_EQ(names.instance(0).nodes.last, 7);
    EXPECT_TRUE(names.instance(0).is_alone && names.keeps_plain_numbers());
    EXPECT_EQ(names.if_reference(" i . \"A B\" "), "a b");
    EXPECT_EQ(names.if_reference("I.7"), "7");
    EXPECT_EQ(names.if_reference("I.c"), std::nullopt);
    EXPECT_EQ(names.if_reference("1.7"), std::nullopt);
}

class PartDecks : public DeckSemantics {
protected:
    const std::string sheet_ = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n*ELEMENT, TYPE=S3, ELSET=E\n1,1,2,3\n";

    std::string error_of(const std::string& text) const {
        try {
            read(text);
        } catch (const ReadError& error) {
            return error.what();
        }
        return "no error";
    }
};

TEST_F(PartDecks, AreFlatWithInstancesInTheirPlace) {
    const Mesh mesh =
        read("*PART, NAME=P\n" + sheet_ +
             "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n"
             "*INSTANCE, NAME=J, PART=p\n0., 0., 2.\n*END INSTANCE\n*END ASSEMBLY\n*STEP\n*CLOAD\nJ.2, 1, 1.\n");
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 11, 12, 13));
    EXPECT_EQ(place(mesh, 12), Vec3(1, 0, 2));
    EXPECT_THAT(element_set(mesh, "J_E"), ElementsAre(11));
    EXPECT_THAT(rows(mesh, "CLOAD"), ElementsAre(Row{"12", "1", "1."}));
    const auto& instances = solver_input(mesh)->instances();
    ASSERT_EQ(instances.size(), 2u);
    EXPECT_EQ(instances[1].name, "J");
    EXPECT_EQ(instances[1].offset, 10);
    EXPECT_THAT(instances[1].nodes, ElementsAre(11, 13));
}

TEST_F(PartDecks, NumbersThatNobodyElseHasStay) {
    const Mesh mesh = read("*PART, NAME=P\n" + sheet_ + "*END PART\n*PART, NAME=Q\n*NODE\n7,0,0,0\n8,1,0,0\n9,0,1,0\n" +
                           "*ELEMENT, TYPE=S3, ELSET=F\n4,7,8,9\n*END PART\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n"
                           "*INSTANCE, NAME=J, PART=Q\n*END INSTANCE\n");
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 7, 8, 9));
    EXPECT_THAT(element_set(mesh, "F"), ElementsAre(4)) << "and so do names";
}

TEST_F(PartDecks, NumbersNearTheLargestStayWhereTheyCan) {
    const std::string high = "*NODE\n2147483640,0,0,0\n2147483641,1,0,0\n2147483642,0,1,0\n";
    const std::string ends = "*END PART\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*INSTANCE, NAME=J, PART=";
    const Mesh mesh =
        read("*PART, NAME=Q\n" + sheet_ + "*END PART\n*PART, NAME=P\n" + high + ends + "Q\n*END INSTANCE\n");
    EXPECT_THAT(mesh.node_ids, ElementsAre(2147483640, 2147483641, 2147483642, 1, 2, 3));
    const Mesh last = read("*PART, NAME=P\n" + high + ends + "P\n*END INSTANCE\n");
    EXPECT_EQ(last.node_ids.back(), 2147483645);
    EXPECT_THAT(error_of("*PART, NAME=P\n" + high + "2147483645,1,1,1\n" + ends + "P\n*END INSTANCE\n"),
                HasSubstr("deck.inp:10: instance 'J' has numbers up to 2147483645"));
    const std::string half = "*NODE\n1400000000,0,0,0\n1400000003,1,0,0\n1400000004,0,1,0\n";
    const Mesh close = read("*PART, NAME=P\n" + half + ends + "P\n*END INSTANCE\n");
    EXPECT_THAT(close.node_ids, ElementsAre(1400000000, 1400000003, 1400000004, 1400000005, 1400000008, 1400000009));
}

TEST_F(PartDecks, NamesAreCutWhereTheyAreTooLong) {
    const std::string name(78, 'N');
    const Mesh mesh =
        read("*PART, NAME=P\n" + sheet_ + "*NSET, NSET=" + name + "\n1\n*END PART\n" +
             "*INSTANCE, NAME=LONG, PART=P\n*END INSTANCE\n*INSTANCE, NAME=LONG2, PART=P\n*END INSTANCE\n");
    EXPECT_THAT(node_set(mesh, "LONG_" + name.substr(0, 75)), ElementsAre(1));
    EXPECT_THAT(node_set(mesh, "LONG2_" + name.substr(0, 74)), ElementsAre(11));
}

TEST_F(PartDecks, NamesMadeDoNotMeetOthers) {
    const Mesh mesh = read("*PART, NAME=P\n" + sheet_ +
                           "*END PART\n*ASSEMBLY\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n"
                           "*INSTANCE, NAME=J, PART=P\n*END INSTANCE\n*ELSET, ELSET=J_E\nI.1\n*END ASSEMBLY\n");
    EXPECT_THAT(element_set(mesh, "I_E"), ElementsAre(1));
    EXPECT_THAT(element_set(mesh, "J_E"), ElementsAre(1)) << "the assembly's own";
    EXPECT_THAT(element_set(mesh, "J_E_2"), ElementsAre(11));
}

TEST_F(PartDecks, OthersAreLeftAlone) {
    SolverInput input;
    input.cards().push_back(card_of("*NODE\n1, 0., 0., 0.\n"));
    flatten_parts(input);
    EXPECT_EQ(text_of(input.cards().front()), "*NODE\n1, 0., 0., 0.\n");
    EXPECT_THAT(input.instances(), testing::IsEmpty());
    EXPECT_THAT(input.warnings(), testing::IsEmpty());
}

TEST(FlatToCalculix, SupportsByNameAreNumbers) {
    std::vector<Card> cards{card_of("*BOUNDARY\nA, XASYMM\nB, ysymm\n** c\nC, 1, 2, 0.5"),
                            card_of("*STEP,\n NLGEOM\n")};
    std::vector<std::string> warnings;
    fit_to_calculix(cards, warnings);
    EXPECT_EQ(text_of(cards[0]), "*BOUNDARY\nA, 2, 4\nB, 2, 2\n** c\nC, 1, 2, 0.5\nB, 4, 4\n");
    EXPECT_THAT(warnings, testing::IsEmpty());
}

TEST_F(PartDecks, ReferenceNodesAreNumbers) {
    const std::string start = "*PART, NAME=P\n" + sheet_ + "*NSET, NSET=ALL\n1,2,3\n*END PART\n*ASSEMBLY\n" +
                              "*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*NODE\n1, 5., 5., 5.\n*NSET, NSET=";
    const Mesh mesh = read(start + "RP\n1\n*RIGID BODY, NSET=I.ALL, REF NODE=RP\n*END ASSEMBLY\n");
    const auto& cards = solver_input(mesh)->cards();
    const auto body = std::ranges::find(cards, "RIGIDBODY", &Card::keyword);
    ASSERT_NE(body, cards.end());
    EXPECT_EQ(*body->parameter("REFNODE"), "11");
    EXPECT_EQ(*body->parameter("NSET"), "ALL");
    const Mesh several = read(start + "RP\n1, I.2\n*RIGID BODY, NSET=ALL, REF NODE=RP\n*END ASSEMBLY\n");
    EXPECT_THAT(solver_input(several)->warnings().back(),
                HasSubstr("deck.inp:18: REFNODE=RP is a set of several nodes; CalculiX wants the number of one node"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
