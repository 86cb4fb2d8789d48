// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/card_edits.h"

#include "deck/card_numbers.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace rule_testing;

const char* const text = "*CLOAD, OP=NEW\n1, 1, 10.\n** remark\n2, 1, 20.\n3, 1, 30.\n";

struct CardEditsTest : testing::Test {
    CardEditsTest() { card.set_text(text); }
    /// Goes to the data line that begins with `node`.
    CardReader at(char node) const {
        CardReader reader(card);
        while (reader.next_data_line() && reader.line()[0] != node) {
        }
        return reader;
    }
    std::string applied() {
        Card copy = card;
        edits.apply(copy);
        std::string out;
        for (const DeckText& piece : copy.text) out += piece.text;
        return out;
    }
    Card card;
    CardEdits edits;
};

TEST_F(CardEditsTest, ChangeNothingWhenThereAreNone) {
    EXPECT_TRUE(edits.empty());
    EXPECT_EQ(applied(), text);
}

TEST_F(CardEditsTest, DropAddAndReplaceLines) {
    edits.drop(at('1'));
    EXPECT_FALSE(edits.empty());
    edits.add_after(at('2'), "7, 1, 20.");
    edits.add_after(at('2'), "8, 1, 20.");
    edits.replace(at('3'), "9, 1, 30.");
    EXPECT_EQ(applied(), "*CLOAD, OP=NEW\n** remark\n2, 1, 20.\n7, 1, 20.\n8, 1, 20.\n9, 1, 30.\n");
}

TEST_F(CardEditsTest, AppendAfterTheLastLine) {
    edits.append(card, "7, 1, 1.");
    edits.append(card, "8, 1, 1.");
    EXPECT_EQ(applied(), std::string(text) + "7, 1, 1.\n8, 1, 1.\n");
    card.set_text("*CLOAD\n");
    CardEdits others;
    others.append(card, "7, 1, 1.");
    others.apply(card);
    EXPECT_EQ(card.text.front().text, "*CLOAD\n");
    EXPECT_EQ(card.text.back().text, "7, 1, 1.\n");
}

TEST_F(CardEditsTest, KeepTheLineNumbersOfWhatStays) {
    edits.replace(at('2'), "7, 1, 20.");
    edits.apply(card);
    CardReader reader(card);
    std::vector<std::string> places;
    while (reader.next_data_line()) places.push_back(reader.where());
    ASSERT_EQ(places.size(), 3u);
    EXPECT_THAT(places[0], testing::HasSubstr(":2: "));
    EXPECT_THAT(places[1], testing::HasSubstr(":4 (carried over)"));
    EXPECT_THAT(places[2], testing::HasSubstr(":5: "));
    // What is made from what was made has the place of that.
    reader = CardReader(card);
    reader.next_data_line();
    reader.next_data_line();
    CardEdits more;
    more.replace(reader, "9, 1, 20.");
    more.apply(card);
    reader = CardReader(card);
    reader.next_data_line();
    reader.next_data_line();
    EXPECT_EQ(reader.field(), "9");
    EXPECT_EQ(reader.where(), places[1]);
}

TEST(NumberText, FitsCalculixAndIsNoWholeNumber) {
    EXPECT_EQ(number_text(10), "10.");
    EXPECT_EQ(number_text(-0.25), "-0.25");
    EXPECT_EQ(number_text(1e30), "1e+30");
    for (const double value : {1.0 / 3, -1.0 / 3e-7, 1.2345678901234567e-200}) {
        const std::string written = number_text(value);
        EXPECT_LE(written.size(), 20u);
        EXPECT_NEAR(std::stod(written) / value, 1, 1e-12);
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
