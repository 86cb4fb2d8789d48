// SPDX-License-Identifier: LGPL-2.1-or-later
// Text files of decks: packed or not, taken apart into cards, with what they include.
#include "io/inp_cards.h"

#include "deck_testing.h"
#include "io/inp_file.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using testing::ElementsAre;
using testing::HasSubstr;

class InpCards : public DeckSemantics {
protected:
    fs::path with(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    std::vector<Card> cards_of(const fs::path& deck) { return read_cards(deck, remarks_); }
    static std::vector<std::string> texts(const std::vector<Card>& cards) {
        std::vector<std::string> out;
        for (const Card& card : cards) {
            out.emplace_back();
            for (const DeckText& t : card.text) out.back() += t.text;
        }
        return out;
    }
    static std::vector<std::string> keywords(const std::vector<Card>& cards) {
        std::vector<std::string> out;
        for (const Card& card : cards) out.push_back(card.keyword);
        return out;
    }

    std::vector<std::string> remarks_;
};

TEST_F(InpCards, AreTheTextBetweenKeywords) {
    const std::string text = "** a deck\n*Node, nset=A\n1, 0.\n** more\n\n*STEP\n*end  step";
    const std::vector<Card> cards = cards_of(with("a.inp", text));
    EXPECT_THAT(keywords(cards), ElementsAre("", "NODE", "STEP", "ENDSTEP"));
    EXPECT_EQ(*cards[1].parameter("NSET"), "A");
    EXPECT_EQ(cards[1].parameter("ELSET"), nullptr);
    EXPECT_THAT(cards[2].where(), HasSubstr("a.inp:6"));
    std::string whole;
    for (const std::string& t : texts(cards)) whole += t;
    EXPECT_EQ(whole.substr(0, text.size()), text) << "nothing is lost";
}

TEST_F(InpCards, ResolveIncludes) {
    with("nodes.inc", "2, 1.\n3, 2.\n*ELEMENT, TYPE=S3\n");
    const std::vector<Card> cards =
        cards_of(with("a.inp", "*NODE\n1, 0.\n*INCLUDE, INPUT=nodes.inc\n1, 1, 2, 3\n*STEP\n"));
    EXPECT_THAT(keywords(cards), ElementsAre("NODE", "ELEMENT", "STEP"));
    EXPECT_EQ(texts(cards)[0], "*NODE\n1, 0.\n2, 1.\n3, 2.\n");
    EXPECT_EQ(texts(cards)[1], "*ELEMENT, TYPE=S3\n1, 1, 2, 3\n");
    EXPECT_THAT(cards[1].where(), HasSubstr("nodes.inc:3"));
}

TEST_F(InpCards, AreUtf8InEveryFile) {
    with("nodes.inc", "** Tr\xe4ger\r2, 1.\r");
    with("\u00e4.inc", "3, 2.\n");
    const std::vector<Card> cards = cards_of(with(
        "a.inp",
        "\xEF\xBB\xBF*NODE, NSET=Gr\u00f6\u00dfe\n1, 0.\n*INCLUDE, INPUT=nodes.inc\n*INCLUDE, INPUT=\u00e4.inc\n"));
    ASSERT_THAT(keywords(cards), ElementsAre("NODE"));
    EXPECT_EQ(texts(cards)[0], "*NODE, NSET=Gr\u00f6\u00dfe\n1, 0.\n** Tr\u00e4ger\n2, 1.\n3, 2.\n");
    EXPECT_THAT(remarks_, ElementsAre(HasSubstr("nodes.inc:1: the text is not UTF-8")));
}

TEST_F(InpCards, RefuseWhatCannotBeIncluded) {
    const auto error = [&](const std::string& text) {
        std::string out = "no error";
        try {
            cards_of(with("a.inp", text));
        } catch (const ReadError& e) {
            out = e.what();
        }
        return out;
    };
    EXPECT_THAT(error("*NODE\n*INCLUDE, INPUT=none.inc\n"),
                testing::AllOf(HasSubstr("a.inp:2"), HasSubstr("none.inc")));
    EXPECT_THAT(error("*NODE\n*INCLUDE, INPUT=a.inp\n"), HasSubstr("a.inp"));
    EXPECT_THAT([&] { cards_of(folder_ / "missing.inp"); },
                testing::ThrowsMessage<ReadError>(HasSubstr("missing.inp")));
}

TEST_F(InpCards, FilesMayBePacked) {
    std::string text;
    for (int k = 0; k < 5000; ++k) text += std::to_string(k) + ", 0.25\n";
    save_text(folder_ / "plain.inp", text);
    save_text(folder_ / "packed.inp.gz", text);
    EXPECT_EQ(fs::file_size(folder_ / "plain.inp"), text.size());
    EXPECT_LT(fs::file_size(folder_ / "packed.inp.gz"), text.size() / 2);
    EXPECT_EQ(load_bytes(folder_ / "plain.inp"), text);
    EXPECT_EQ(load_bytes(folder_ / "packed.inp.gz"), text);
    fs::rename(folder_ / "packed.inp.gz", folder_ / "misnamed.inp");
    EXPECT_EQ(load_bytes(folder_ / "misnamed.inp"), text) << "whatever the name";
    EXPECT_THAT([&] { load_bytes(folder_ / "none.inp"); }, testing::ThrowsMessage<ReadError>(HasSubstr("none.inp")));
    EXPECT_THAT([&] { save_text(folder_ / "none" / "a.inp", text); },
                testing::ThrowsMessage<WriteError>(HasSubstr("a.inp")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
