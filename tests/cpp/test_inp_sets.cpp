// SPDX-License-Identifier: LGPL-2.1-or-later
// Where nodes and elements stand in a deck, and how its sets come to have the members of the mesh's groups.
#include "io/inp_sets.h"

#include "deck/edge_beams.h"
#include "io/inp.h"
#include "io/inp_places.h"
#include "rule_testing.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace rule_testing;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(DeckPlaces, FollowFromWhatAnElementIs) {
    // A cube of solids, a face and an edge of it, a triangle and a segment of their own, a point.
    Mesh mesh = checks::grid(1, 1, 1);
    const auto n = [&](double x, double y, double z) { return checks::number_near(mesh, {x, y, z}); };
    const Index far = mesh.add_node({5, 0, 0}, 900), farther = mesh.add_node({5, 1, 0}, 901);
    mesh.add_cell(CellType::triangle, std::array{n(0, 0, 0), n(1, 1, 0), n(1, 0, 0)}, 200);
    mesh.add_cell(CellType::triangle, std::array{n(1, 0, 0), far, farther}, 201);
    mesh.add_cell(CellType::line, std::array{n(0, 0, 0), n(1, 0, 0)}, 210);
    mesh.add_cell(CellType::line, std::array{far, farther}, 211);
    mesh.add_cell(CellType::line, std::array{n(0, 0, 1), far}, 212);
    mesh.add_cell(CellType::vertex, std::array{far}, 220);
    const DeckPlaces places = find_deck_places(mesh, SolverInput());
    for (Index c = 0; c < 6; ++c) EXPECT_EQ(places.fate({CellType::tetra, c}), Fate::free);
    EXPECT_THAT(places.fates_of(CellType::triangle), ElementsAre(Fate::face, Fate::free));
    EXPECT_THAT(places.fates_of(CellType::line), ElementsAre(Fate::edge, Fate::edge, Fate::free));
    EXPECT_THAT(places.fates_of(CellType::vertex), ElementsAre(Fate::point));
    ASSERT_EQ(places.loose.size(), 6u);
    for (const LooseElement& e : places.loose) {
        const Index id = mesh.block(e.type).ids[e.cell];
        if (id == 200) {
            EXPECT_EQ(e.owner.type, CellType::tetra);
            EXPECT_GE(e.face, 1);
        } else if (id == 210) {
            EXPECT_EQ(e.owner.type, CellType::tetra);
            EXPECT_EQ(e.face, 0) << "no face of the solid";
        } else if (id == 211) {
            EXPECT_EQ(e.owner.type, CellType::triangle);
            EXPECT_EQ(e.face, 4) << "the shell's second edge";
        }
    }
}

TEST(DeckLosses, AreElementsThatAreNotWrittenAsSuch) {
    Mesh mesh = checks::grid(1, 1, 1);
    EXPECT_THAT(inp_losses(mesh), ElementsAre());
    const auto n = [&](double x, double y, double z) { return checks::number_near(mesh, {x, y, z}); };
    const Index far = mesh.add_node({5, 0, 0}, 900);
    const FamilyIndex bars = checks::family_of(mesh, "BARS", GroupKind::element);
    mesh.add_cell(CellType::triangle, std::array{n(0, 0, 0), n(1, 1, 0), n(1, 0, 0)}, 200);
    mesh.add_cell(CellType::line, std::array{n(0, 0, 0), n(1, 0, 0)}, 210);
    mesh.add_cell(CellType::line, std::array{n(0, 0, 0), n(0, 1, 0)}, 211, bars);
    mesh.add_cell(CellType::line, std::array{n(0, 0, 1), far}, 212, bars);  // a beam of its own
    mesh.add_cell(CellType::vertex, std::array{far}, 220, bars);
    EXPECT_THAT(inp_losses(mesh),
                ElementsAre("1 element of the type vertex (their groups are node sets)",
                            "2 elements of the type line on edges of others, which would be beams (their groups are "
                            "node sets; 1 of them in none)",
                            "1 element of the type triangle on faces of solids, which would be shells (in no group)"));
    mark_edge_beams(mesh);
    EXPECT_EQ(inp_losses(mesh).size(), 2u);
}

TEST(DeckPlaces, RefuseElementsCalculixHasNot) {
    Mesh mesh;
    for (int k = 0; k < 7; ++k) mesh.add_node(Vec3(k % 2, k / 2 % 2, k / 4), k + 1);
    mesh.add_cell(CellType::triangle7, std::array<Index, 7>{0, 1, 2, 3, 4, 5, 6}, 1);
    EXPECT_THAT([&] { find_deck_places(mesh, SolverInput()); },
                testing::ThrowsMessage<WriteError>(HasSubstr("1 elements of type triangle7")));
}

class DeckSets : public RuleTest {
protected:
    static DeckSetPlan plan(const Mesh& mesh) {
        const SolverInput none;
        const SolverInput& input = mesh.companion ? *solver_input(mesh) : none;
        return plan_sets(mesh, input, NumberIndex(mesh), DeckSetIndex(input.sets()), find_deck_places(mesh, input));
    }
    static std::size_t set(const Mesh& mesh, const char* name) {
        const auto& sets = solver_input(mesh)->sets();
        return static_cast<std::size_t>(std::ranges::find(sets, name, &DeckSet::name) - sets.begin());
    }
};

TEST_F(DeckSets, KnowTheCardOfEachElement) {
    const Mesh mesh = two_tetras("*ELEMENT, TYPE=C3D4\n7, 1, 2, 4, 5\n");
    const DeckPlaces places = find_deck_places(mesh, *solver_input(mesh));
    const auto& cards = solver_input(mesh)->cards();
    const auto& families = mesh.block(CellType::tetra).families;
    const std::size_t first = places.card_of_family[families[0]], last = places.card_of_family[families[2]];
    EXPECT_EQ(cards[first].keyword, "ELEMENT");
    EXPECT_EQ(cards[last].keyword, "ELEMENT");
    EXPECT_LT(first, last);
    EXPECT_EQ(places.card_of_family[families[1]], first);
    EXPECT_THAT(places.fates_of(CellType::tetra), ElementsAre(Fate::card, Fate::card, Fate::card));
    EXPECT_TRUE(places.loose.empty());
}

TEST_F(DeckSets, AreLeftToTheirCardsWhereTheseAreTrue) {
    const Mesh mesh = two_tetras("*NSET, NSET=A\n1, 3\n*NSET, NSET=B\nA, 5\n");
    const DeckSetPlan all = plan(mesh);
    for (const SetRole& role : all.roles) EXPECT_EQ(role.state, SetRole::by_cards);
    EXPECT_THAT(all.members[set(mesh, "B")], ElementsAre(1, 3, 5));
    EXPECT_TRUE(all.has_own_card[set(mesh, "A")]);
    EXPECT_FALSE(all.has_own_card[set(mesh, "NALL")]);
    EXPECT_TRUE(all.new_sets.empty());
    for (const char drops : all.drops_parameter) EXPECT_FALSE(drops);
}

TEST_F(DeckSets, AreListedAnewWhereMembersChanged) {
    Mesh mesh = two_tetras("*NSET, NSET=A\n1, 3\n*NSET, NSET=B\nA, 5\n");
    set_group_members(mesh, *mesh.find_group("A"), {GroupKind::node, {1, 4}, {}});
    const DeckSetPlan changed = plan(mesh);
    EXPECT_EQ(changed.roles[set(mesh, "A")].state, SetRole::replaced);
    EXPECT_THAT(changed.members[set(mesh, "A")], ElementsAre(1, 4));
    EXPECT_EQ(changed.roles[set(mesh, "B")].state, SetRole::replaced) << "it names the other";
    EXPECT_EQ(changed.roles[set(mesh, "NALL")].state, SetRole::by_cards);
    remove_group(mesh, *mesh.find_group("A"));
    EXPECT_EQ(plan(mesh).roles[set(mesh, "A")].state, SetRole::dropped);
}

TEST_F(DeckSets, OfACardsParameterNeedAllThatStandsThere) {
    Mesh mesh = two_tetras("");
    set_group_members(mesh, *mesh.find_group("NALL"), {GroupKind::node, {1, 2, 3}, {}});
    const DeckSetPlan changed = plan(mesh);
    EXPECT_EQ(std::ranges::count(changed.drops_parameter, 1), 1) << "*NODE, NSET=NALL would be untrue";
}

TEST_F(DeckSets, OfFacesAndEdgesBecomeSurfacesAndNodeSets) {
    Mesh mesh = checks::grid(1, 1, 1);
    const FamilyIndex side = checks::family_of(mesh, "SIDE", GroupKind::element);
    checks::add_plate(mesh, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1, side);
    const DeckSetPlan made = plan(mesh);
    ASSERT_EQ(made.new_sets.size(), 2u);
    EXPECT_EQ(made.new_sets[0].type, DeckSetType::nset);
    EXPECT_EQ(made.new_sets[0].members.size(), 4u);
    EXPECT_EQ(made.new_sets[1].type, DeckSetType::element_surface);
    EXPECT_EQ(made.new_sets[1].members.size(), 2u);
    EXPECT_EQ(made.new_sets[1].remark, "** 2 faces of element group 'SIDE' on other elements");
}

TEST_F(DeckSets, RefuseNamesThatAreNone) {
    Mesh mesh = checks::grid(1, 1, 1);
    mesh.add_group("A,B", GroupKind::node);
    EXPECT_THAT([&] { plan(mesh); }, testing::ThrowsMessage<WriteError>(HasSubstr("'A,B' cannot be a CalculiX set")));
    for (const std::string name : {" A", "A ", "\tA", "A\t", "*A", "A\nB"}) {
        mesh.groups[0].name = name;
        EXPECT_THAT([&] { plan(mesh); }, testing::ThrowsMessage<WriteError>(HasSubstr("cannot be a CalculiX set")))
            << "'" << name << "'";
    }
    mesh.groups[0].name = std::string("A\0B", 3);
    EXPECT_THROW(plan(mesh), WriteError);
    mesh.groups[0].name = "AB";
    mesh.add_group("a b", GroupKind::node);
    EXPECT_THAT([&] { plan(mesh); }, testing::ThrowsMessage<WriteError>(HasSubstr("groups 'AB' and 'a b'")));
}

TEST(SetIndex, IsThatOfTheSetOfACard) {
    const std::vector<DeckSet> sets{{.type = DeckSetType::nset, .name = "A", .group = "", .unheld = {}}};
    const DeckSetIndex index(sets);
    Card card;
    card.set_text("*NODE, NSET=a\n");
    EXPECT_EQ(set_index(index, card), 0u);
    card.set_text("*NODE\n");
    EXPECT_EQ(set_index(index, card), std::nullopt);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
