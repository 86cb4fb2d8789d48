// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes without common nodes: groups, cards, thicknesses.
#include "operators/tie.h"

#include <gtest/gtest.h>

#include "deck/model_end.h"
#include "deck/solver_input.h"
#include "deck/tie_cards.h"
#include "operators/sections.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

std::shared_ptr<SolverInput> deck_of(const std::vector<std::string>& cards) {
    auto deck = std::make_shared<SolverInput>();
    for (const std::string& text : cards) deck->cards().emplace_back().set_text(text);
    return deck;
}

std::vector<std::string> keywords(const SolverInput& deck) {
    std::vector<std::string> out;
    for (const Card& card : deck.cards()) out.push_back(card.keyword);
    return out;
}

TEST(ModelEnd, IsBeforeTheFirstStepAndAfterTheLastSet) {
    const auto add = [](SolverInput& deck) {
        std::vector<Card> cards(1);
        cards[0].set_text("*TIE, NAME=T\nA, B\n");
        add_to_model(deck, std::move(cards));
        return keywords(deck);
    };
    auto usual = deck_of({"*NODE\n", "*ELEMENT, TYPE=U1\n", "*STEP\n", "*END STEP\n"});
    usual->other_elements().push_back({7, "U1", {}, 1});
    usual->other_elements().push_back({8, "U1", {}, 3});
    EXPECT_THAT(add(*usual), testing::ElementsAre("NODE", "ELEMENT", "TIE", "STEP", "ENDSTEP"));
    EXPECT_EQ(usual->other_elements()[0].card, 1u);
    EXPECT_EQ(usual->other_elements()[1].card, 4u);
    EXPECT_THAT(add(*deck_of({"*NODE\n", "*STEP\n", "*NSET, NSET=N\n1,\n", "*END STEP\n"})),
                testing::ElementsAre("NODE", "STEP", "NSET", "TIE", "ENDSTEP"));
    EXPECT_THAT(add(*deck_of({"*NODE\n"})), testing::ElementsAre("NODE", "TIE"));
}

TEST(TieCards, ThicknessIsThatOfTheLastSection) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 1);
    const FamilyIndex all = checks::family_of(mesh, "ALL", GroupKind::element);
    for (FamilyIndex& f : mesh.block(CellType::triangle).families) f = all;
    const GroupIndex top = mesh.add_group("TOP", GroupKind::facet);
    mesh.facets.push_back({CellType::triangle, 2, mesh.families.with(0, top), 0});
    EXPECT_FALSE(half_thickness(mesh, top));
    const auto with = [&](const std::vector<std::string>& cards) {
        auto deck = deck_of(cards);
        DeckSet set;
        set.type = DeckSetType::elset;
        set.name = set.group = "ALL";
        deck->sets().push_back(set);
        mesh.companion = deck;
        return half_thickness(mesh, top);
    };
    EXPECT_EQ(with({"*SHELL SECTION, ELSET=All, MATERIAL=M\n0.3\n"}), 0.15);
    EXPECT_EQ(with({"*SHELL SECTION, ELSET=ALL, MATERIAL=M\n0.3\n", "*SHELL SECTION, ELSET=ALL, MATERIAL=M\n0.5\n"}),
              0.25);
    EXPECT_EQ(with({"*SHELL SECTION, ELSET=ALL, COMPOSITE\n0.3,,A\n0.1,,B\n"}), 0.2);
    EXPECT_FALSE(with({"*SHELL SECTION, ELSET=OTHER, MATERIAL=M\n0.3\n"}));
    Mesh solid = checks::grid(1, 1, 1);
    const GroupIndex face = solid.add_group("FACE", GroupKind::facet);
    solid.facets.push_back({CellType::tetra, 1, solid.families.with(0, face), 0});
    EXPECT_EQ(half_thickness(solid, face), 0);
}

TEST(Tie, GetsGroupsAndCards) {
    Mesh mesh = checks::grid(3, 3, 1), cube = checks::grid(1, 1, 1);
    for (Vec3& x : cube.points) x += Vec3(1, 1, 1);
    mesh.companion = deck_of({"*NODE\n", "*STEP\n", "*END STEP\n"});
    MergeOptions options;
    options.name = "T";
    options.tie = true;
    const Result out = merge(mesh, cube, options);
    out.mesh.validate();
    EXPECT_EQ(out.mesh.node_count(), mesh.node_count() + 8);
    const SolverInput& deck = *solver_input(out.mesh);
    EXPECT_THAT(keywords(deck), testing::ElementsAre("NODE", "SURFACE", "SURFACE", "TIE", "STEP", "ENDSTEP"));
    EXPECT_EQ(deck.cards()[3].text.front().text.substr(deck.cards()[3].head), "T_TIE_ADDED, T_TIE_MESH\n");
    EXPECT_EQ(group_members(out.mesh, *out.mesh.find_group("T_TIE_MESH")).ids.size(), 2u);
    // A finer one is the slave.
    const Result turned = merge(cube, mesh, options);
    EXPECT_THAT(turned.report.warnings, testing::Contains(testing::HasSubstr("T_TIE_ADDED, T_TIE_MESH")));
    // Its section is missing; a mesh without a deck needs none.
    Report report;
    warn_of_sections(mesh, out.mesh, "T_ADDED", report);
    EXPECT_THAT(report.warnings, testing::ElementsAre(testing::HasSubstr("ELSET=T_ADDED")));
    warn_of_sections(cube, turned.mesh, "T_ADDED", report);
    EXPECT_EQ(report.warnings.size(), 1u);
    // Names are looked at first.
    EXPECT_THROW(merge(out.mesh, cube, options), ToolError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
