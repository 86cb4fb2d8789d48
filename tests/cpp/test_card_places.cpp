// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/card_places.h"

#include "deck/card_edits.h"
#include "deck_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;

class CardPlaces : public DeckSemantics {
protected:
    void save(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

    /// Where the data lines of the cards stand, without the folder.
    std::vector<std::string> places(const Mesh& mesh) const {
        std::vector<std::string> out;
        for (const Card& card : solver_input(mesh)->cards())
            for (CardReader line(card); line.next_data_line();) {
                std::string where = line.where();
                if (where.starts_with(folder_.string())) where.erase(0, folder_.string().size() + 1);
                out.push_back(where);
            }
        return out;
    }
};

const char* const nodes = "*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 0., 1., 0.\n4, 0., 0., 1.\n";
const char* const element = "*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4\n";

TEST_F(CardPlaces, ArePutOnADeckThatWasWritten) {
    save("part.inc", "** one\n*NSET, NSET=N\n1, 2\n3\n");
    save("deck.inp", std::string(nodes) + "*INCLUDE, INPUT=part.inc\n" + element + "*BOUNDARY\nN, 1\n** end");
    const Mesh mesh = read_inp(folder_ / "deck.inp");
    write_inp(mesh, folder_ / "flat.inp");
    Mesh flat = read_inp(folder_ / "flat.inp");
    ASSERT_NE(places(flat), places(mesh));
    const auto deck = std::make_shared<SolverInput>(*solver_input(flat));
    set_card_places(*deck, card_places(*solver_input(mesh)));
    flat.companion = deck;
    EXPECT_EQ(places(flat), places(mesh));
    EXPECT_EQ(places(flat).back(), "deck.inp:10: ");
    EXPECT_EQ(places(flat)[4], "part.inc:3: ");
    write_inp(flat, folder_ / "again.inp");
    std::ifstream a(folder_ / "flat.inp"), b(folder_ / "again.inp");
    std::stringstream first, second;
    first << a.rdbuf(), second << b.rdbuf();
    EXPECT_EQ(first.str(), second.str()) << "the text is the same";
}

TEST_F(CardPlaces, OfCarriedLinesAreThoseTheyCameFrom) {
    save("deck.inp", std::string(nodes) + element + "*CLOAD\n1, 1, 5.\n2, 1, 5.\n3, 1, 5.\n");
    Mesh mesh = read_inp(folder_ / "deck.inp");
    const auto changed = std::make_shared<SolverInput>(*solver_input(mesh));
    Card& card = changed->cards().back();
    CardEdits edits;
    CardReader line(card);
    line.next_data_line();
    edits.replace(line, "4, 1, 5.");
    edits.apply(card);
    mesh.companion = changed;
    write_inp(mesh, folder_ / "flat.inp");
    Mesh flat = read_inp(folder_ / "flat.inp");
    const auto deck = std::make_shared<SolverInput>(*solver_input(flat));
    set_card_places(*deck, card_places(*changed));
    flat.companion = deck;
    const std::vector<std::string> found = places(flat);
    EXPECT_EQ(found[found.size() - 3], "deck.inp:9 (carried over): ");
    EXPECT_EQ(found.back(), "deck.inp:11: ");
}

TEST_F(CardPlaces, OfOtherCardsAreLeftOut) {
    save("deck.inp", std::string(nodes) + element + "*CLOAD\n1, 1, 5.\n");
    const Mesh mesh = read_inp(folder_ / "deck.inp");
    const auto deck = std::make_shared<SolverInput>(*solver_input(mesh));
    auto wrong = card_places(*deck);
    wrong.back() = {{70, 3, "other.inp", false}};
    wrong.front().front().first = 31;
    set_card_places(*deck, wrong);
    EXPECT_TRUE(deck->cards().back().where().ends_with("deck.inp:8")) << "it has no three lines";
    EXPECT_EQ(deck->cards().front().where(), "deck.inp:31");
    wrong.pop_back();
    wrong.front().front().first = 41;
    set_card_places(*deck, wrong);
    EXPECT_EQ(deck->cards().front().where(), "deck.inp:31") << "there are more cards";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
