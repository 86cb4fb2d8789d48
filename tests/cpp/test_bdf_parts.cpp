// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "error.h"
#include "io/bdf_sets.h"
#include "io/bdf_source.h"
#include "io/bdf_systems.h"
#include "io/bdf_types.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// A deck for the time of a test.
struct Deck {
    explicit Deck(const std::string& text) { std::ofstream(path) << text; }
    ~Deck() { fs::remove(path); }
    fs::path path = fs::path(testing::TempDir()) / ("femscalpel_deck_" + std::to_string(::getpid()) + ".bdf");
};

TEST(BdfReal, KnowsExponentsWithoutALetter) {
    EXPECT_EQ(bdf_real("1.5"), 1.5);
    EXPECT_EQ(bdf_real("+1.5-3"), 1.5e-3);
    EXPECT_EQ(bdf_real("-.5+2"), -50);
    EXPECT_EQ(bdf_real("1.5D-3"), 1.5e-3);
    EXPECT_EQ(bdf_real("1.e+3"), 1e3);
    EXPECT_EQ(bdf_real("1e3"), 1e3);
    EXPECT_EQ(bdf_real("7"), 7);
    for (const char* text : {"", "-", "1.5x", "nan", "inf", "1.5-3-2", "--1", "1. 5", "1e", "1e999"})
        EXPECT_FALSE(bdf_real(text)) << text;
}

TEST(BdfNumbersOfSets, AreSingleRangesStepsAndExceptions) {
    const std::vector<Index> all{1, 2, 3, 4, 5, 6, 7, 8, 10, 20, 30, 40};
    const auto listed = [&](const std::vector<std::string>& words) {
        BdfNumbers numbers;
        EXPECT_TRUE(numbers.parse(words));
        return numbers.among(all);
    };
    EXPECT_THAT(listed({"3", "1", "3"}), ElementsAre(1, 3));
    EXPECT_THAT(listed({"2", "THRU", "5", "30"}), ElementsAre(2, 3, 4, 5, 30));
    EXPECT_THAT(listed({"10", "THRU", "1000000000000", "BY", "20"}), ElementsAre(10, 30));
    EXPECT_THAT(listed({"1", "THRU", "8", "EXCEPT", "3", "4", "20"}), ElementsAre(1, 2, 5, 6, 7, 8, 20));
    EXPECT_THAT(listed({"1", "THRU", "4", "EXCEPT", "2", "6", "THRU", "8"}), ElementsAre(1, 3, 4, 6, 7, 8));
    BdfNumbers numbers;
    EXPECT_TRUE(numbers.parse({"1", "9", "50", "THRU", "60"}));
    EXPECT_EQ(numbers.absent(all), 1);
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"ALL"}, {"1.5"}, {"1", "THRU"}, {"1", "THRU", "X"}, {"1", "THRU", "9", "BY", "0"}, {"EXCEPT", "3"}})
        EXPECT_FALSE(BdfNumbers().parse(words)) << words[0];
}

TEST(BdfNamesOfComments, AreThoseOfPreprocessors) {
    const Deck deck(
        "$HMSET        4        1 \"the nodes\"\n"
        "$HMSET        5        2 \"the elements\"\n"
        "$HMNAME PROP                  3\"the web\" 4\n"
        "$HMNAME COMP                  9\"a component\"\n"
        "$ Femap Property 8 : flange\n"
        "$ Femap Material 8 : steel\n"
        "$ANSA_NAME_COMMENT;11;PSHELL;bottom plate;;NO;NO;\n"
        "$ANSA_NAME_COMMENT;12;PART;a part;;NO;NO;\n"
        "GRID,1\n");
    const BdfNames names = bdf_names(BdfSource(deck.path));
    ASSERT_EQ(names.sets.size(), 2u);
    EXPECT_EQ(names.sets[0].name, "the nodes");
    EXPECT_EQ(names.sets[0].kind, GroupKind::node);
    EXPECT_EQ(names.sets[1].number, 5);
    EXPECT_EQ(names.sets[1].kind, GroupKind::element);
    EXPECT_THAT(names.properties,
                ElementsAre(std::pair(3, "the web"), std::pair(8, "flange"), std::pair(11, "bottom plate")));
    EXPECT_FALSE(names.stand_ins);
}

TEST(BdfCards, AreReadOneByOne) {
    const Deck deck(
        "SOL 101\nCEND\nTITLE = x\nSET 1 = 1,\n 2\nBEGIN BULK\nGRID,1,,2.\n$ no card\n\nFORCE         1\nENDDATA\nx");
    BdfSource source(deck.path);
    BdfCard card;
    ASSERT_TRUE(source.next(card));
    EXPECT_EQ(card.name, "GRID");
    EXPECT_THAT(card.fields, ElementsAre("1", "", "2."));
    EXPECT_EQ(source.real(card, 2, "x"), 2);
    EXPECT_EQ(source.real(card, 7, "x"), 0);
    EXPECT_EQ(source.where(card.at), deck.path.string() + ":7: ");
    ASSERT_TRUE(source.next(card));
    EXPECT_EQ(card.name, "FORCE");
    EXPECT_FALSE(source.next(card));
    Index others = 0;
    const std::vector<BdfSet> sets = bdf_sets(source, others);
    ASSERT_EQ(sets.size(), 1u);
    EXPECT_THAT(sets[0].numbers->among({1, 2, 3}), ElementsAre(1, 2));
    EXPECT_EQ(others, 1);
}

TEST(BdfSystems, DefinedTwiceAreRefused) {
    const Deck deck("CORD1R,3,1,2,4,3,5,6,7\nGRID,1\n");
    BdfSource source(deck.path);
    BdfCard card;
    ASSERT_TRUE(source.next(card));
    BdfSystems systems(source, [](Index, const BdfCard&) { return Vec3(0, 0, 0); });
    EXPECT_THAT([&] { systems.add(card); },
                testing::ThrowsMessage<ReadError>(HasSubstr(":1: coordinate system 3 is defined twice")));
    ASSERT_TRUE(source.next(card));
    EXPECT_FALSE(systems.add(card));
}

TEST(BdfTypes, OrderEachNodeOnce) {
    for (const CellTraits& t : all_cell_types()) {
        const std::string_view name = bdf_card(t.type);
        if (name.empty()) continue;
        const BdfElement* const element = bdf_element(name);
        ASSERT_TRUE(element) << t.name;
        EXPECT_TRUE(element->type == t.type || element->quadratic == t.type) << t.name;
        const auto order = bdf_order(t.type);
        const std::set<int> places(order.begin(), order.begin() + t.nodes);
        EXPECT_EQ(static_cast<int>(places.size()), t.nodes) << t.name;
        EXPECT_EQ(*places.rbegin(), t.nodes - 1) << t.name;
        EXPECT_FALSE(is_foreign_bdf_element(name));
    }
    EXPECT_TRUE(is_foreign_bdf_element("CTRIAX6"));
    EXPECT_EQ(bdf_description("CELAS1"), "springs");
    EXPECT_EQ(bdf_description("PSHELL"), "");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
