// SPDX-License-Identifier: LGPL-2.1-or-later
// What the set cards of a deck of two tetrahedra (1, 2) and five nodes make of their lines.
#include "deck/solver_sets.h"

#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace rule_testing;
using testing::HasSubstr;

Card card(const std::string& text) {
    Card out;
    out.set_text(text);
    return out;
}

TEST(SetOfCard, NamesTheSetThatACardDefines) {
    EXPECT_EQ(set_of_card(card("*NSET, NSET=Ends\n")), std::pair(DeckSetType::nset, std::string("Ends")));
    EXPECT_EQ(set_of_card(card("*ELSET, ELSET=E\n")), std::pair(DeckSetType::elset, std::string("E")));
    EXPECT_EQ(set_of_card(card("*SURFACE, NAME=S\n")), std::pair(DeckSetType::element_surface, std::string("S")));
    EXPECT_EQ(set_of_card(card("*SURFACE, NAME=S, TYPE=NODE\n")),
              std::pair(DeckSetType::node_surface, std::string("S")));
    EXPECT_EQ(set_of_card(card("*NODE, NSET=N\n")), std::pair(DeckSetType::nset, std::string("N")));
    EXPECT_EQ(set_of_card(card("*NODE\n")), std::nullopt);
    EXPECT_EQ(set_of_card(card("*BOUNDARY\n")), std::nullopt);
    const auto refused = [](const std::string& text, const char* why) {
        EXPECT_THAT([&] { set_of_card(card(text)); }, testing::ThrowsMessage<ReadError>(HasSubstr(why)));
    };
    refused("*NSET\n", "*NSET needs NSET=name");
    refused("*NSET, NSET=\n", "NSET= without a name");
    refused("*SURFACE, NAME=S, TYPE=CUTTING\n", "CalculiX knows NODE and ELEMENT");
    refused("*ELSET, ELSET=" + std::string(81, 'A') + "\n", "longer than the 80 characters");
}

TEST(DeckSetIndex, ComparesNamesAsCalculixDoes) {
    const std::vector<DeckSet> sets{{.type = DeckSetType::nset, .name = "Ends", .group = "", .unheld = {}},
                                    {.type = DeckSetType::elset, .name = "ENDS", .group = "", .unheld = {}}};
    const DeckSetIndex index(sets);
    EXPECT_EQ(index.find(DeckSetType::nset, "e NDS"), 0u);
    EXPECT_EQ(index.find(DeckSetType::elset, "ends"), 1u);
    EXPECT_EQ(index.find(DeckSetType::node_surface, "ends"), std::nullopt);
    EXPECT_EQ(index.find(DeckSetType::nset, "end"), std::nullopt);
}

class EvaluateSets : public RuleTest {
protected:
    /// Members of a set, as the cards of a deck say.
    SetMembers members(const std::string& cards, DeckSetType type, const std::string& name,
                       SetRole role = {SetRole::by_cards, {}}) {
        const Mesh mesh = two_tetras(cards);
        const SolverInput& input = *solver_input(mesh);
        const std::size_t set = *DeckSetIndex(input.sets()).find(type, name);
        std::vector<SetRole> roles(input.sets().size());
        roles[set] = role;
        return evaluate_sets(mesh, NumberIndex(mesh), input, members_by_card(mesh, input), roles, nullptr)[set];
    }
};

TEST_F(EvaluateSets, ListsRangesAndSetsAddUp) {
    const std::string cards =
        "*NSET, NSET=A\n3, 1,\n1\n*NSET, NSET=B, GENERATE\n1, 5, 2\n*NSET, NSET=C\nA, 4\n*NSET, NSET=C\n2\n";
    EXPECT_THAT(members(cards, DeckSetType::nset, "A").members, ElementsAre(1, 3));
    EXPECT_THAT(members(cards, DeckSetType::nset, "B").members, ElementsAre(1, 3, 5));
    EXPECT_THAT(members(cards, DeckSetType::nset, "C").members, ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(members(cards, DeckSetType::nset, "NALL").members, ElementsAre(1, 2, 3, 4, 5));
    EXPECT_THAT(members(cards, DeckSetType::elset, "EALL").members, ElementsAre(1, 2));
}

TEST_F(EvaluateSets, CountWhatTheDeckDoesNotDefine) {
    const std::string cards = "*NSET, NSET=A\n3, 99, 98\n*ELSET, ELSET=E\n2, 77\n";
    const SetMembers nodes = members(cards, DeckSetType::nset, "A"), elements = members(cards, DeckSetType::elset, "E");
    EXPECT_THAT(nodes.members, ElementsAre(3));
    EXPECT_EQ(nodes.absent, 2);
    EXPECT_THAT(elements.members, ElementsAre(2));
    EXPECT_THAT(elements.unheld, ElementsAre(std::array<Index, 2>{77, 0}));
    EXPECT_THAT(solver_input(two_tetras(cards))->warnings(),
                ElementsAre(HasSubstr("node set 'A' names node 99 and 1 more that the deck does not define"),
                            HasSubstr("element set 'E' names element 77 that the deck does not define")));
}

TEST_F(EvaluateSets, OfFacesAreElementsTimesEightAndTheFace) {
    const std::string cards = "*SURFACE, NAME=S\nEALL, S2\n1, S4\n*SURFACE, NAME=N, TYPE=NODE\n4\nNALL\n";
    EXPECT_THAT(members(cards, DeckSetType::element_surface, "S").members, ElementsAre(8 + 2, 8 + 4, 16 + 2));
    EXPECT_EQ(members(cards, DeckSetType::node_surface, "N").members.size(), 5u);
}

TEST_F(EvaluateSets, AreReplacedOrDropped) {
    const std::string cards = "*NSET, NSET=A\n3, 1\n*NSET, NSET=C\nA, 4\n";
    const std::vector<Index> others{2, 5};
    EXPECT_THAT(members(cards, DeckSetType::nset, "A", {SetRole::replaced, others}).members, ElementsAre(2, 5));
    EXPECT_THAT(members(cards, DeckSetType::nset, "A", {SetRole::dropped, {}}).members, IsEmpty());
}

TEST_F(EvaluateSets, RefuseWhatCannotBeRead) {
    const auto refused = [&](const std::string& cards, const char* why) {
        EXPECT_THAT([&] { two_tetras(cards); }, testing::ThrowsMessage<ReadError>(HasSubstr(why)));
    };
    refused("*NSET, NSET=A\nNOSUCH\n", "'NOSUCH' is neither a number nor a node set");
    refused("*NSET, NSET=A, GENERATE\n5, 1\n", "GENERATE needs");
    refused("*SURFACE, NAME=S\n1, S5\n", "element 1, a tetra, has no face S5");
    refused("*SURFACE, NAME=S\n1, TOP\n", "'TOP' is not a face");
}

TEST_F(EvaluateSets, MembersByCardAreThoseUnderIt) {
    const Mesh mesh = two_tetras("*NODE\n9, 9., 9., 9.\n");
    const auto by_card = members_by_card(mesh, *solver_input(mesh));
    const auto& cards = solver_input(mesh)->cards();
    ASSERT_EQ(by_card.size(), cards.size());
    std::vector<std::vector<Index>> nodes;
    for (std::size_t c = 0; c < cards.size(); ++c)
        if (cards[c].keyword == "NODE") nodes.push_back(by_card[c]);
    EXPECT_THAT(nodes, ElementsAre(ElementsAre(1, 2, 3, 4, 5), ElementsAre(9)));
}

TEST_F(EvaluateSets, KnowPlaneElements) {
    const Mesh mesh = read(
        "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 0., 1.\n4, 1., 1.\n*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n"
        "*ELEMENT, TYPE=S3\n2, 2, 4, 3\n");
    const std::vector<char> plane = plane_families(mesh, *solver_input(mesh));
    const std::vector<FamilyIndex>& families = mesh.block(CellType::triangle).families;
    EXPECT_TRUE(plane[families[0]]);
    EXPECT_FALSE(plane[families[1]]);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
