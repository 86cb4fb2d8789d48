// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/fit_cards.h"

#include "deck/solver_element.h"
#include "deck_testing.h"

namespace femscalpel::deck_testing {
namespace {

TEST(DeckLabels, OfPartsGoWithThoseOfTheWhole) {
    const std::tuple<const char*, CellType, const char*> cases[] = {
        {"S4", CellType::triangle, "S3"},        {"S8R", CellType::triangle6, "S6"},
        {"cps8r", CellType::triangle6, "CPS6"},  {"CAX4", CellType::triangle, "CAX3"},
        {"M3D8R", CellType::triangle6, "M3D6"},  {"C3D20R", CellType::tetra10, "C3D10"},
        {"C3D8I", CellType::tetra, "C3D4"},      {"C3D8R", CellType::pyramid, "C3D8"},
        {"C3D6", CellType::pyramid, "C3D8"},     {"C3D20R", CellType::pyramid13, "C3D20R"},
        {"C3D15", CellType::pyramid13, "C3D20"}, {"DC3D20", CellType::tetra10, "DC3D10"},
        {"DS8", CellType::triangle6, "DS6"},     {"F3D8", CellType::tetra, "F3D4"},
        {"C3D8H", CellType::tetra, "C3D4H"},     {"C3D20RH", CellType::tetra10, "C3D10H"},
        {"C3D8RHT", CellType::tetra, "C3D4HT"},  {"C3D8IH", CellType::pyramid, "C3D8H"},
        {"CPE4P", CellType::triangle, "CPE3P"},  {"DC2D4", CellType::triangle, "DC2D3"}};
    for (const auto& [label, type, expected] : cases) EXPECT_EQ(deck_label_for(label, type), expected) << label;
}

class FitCards : public DeckSemantics {};

TEST_F(FitCards, PartsComeUnderACardOfTheirOwnBehindTheOld) {
    Mesh mesh = read(
        "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,2,0\n6,2,1\n*ELEMENT, TYPE=S4, ELSET=PLATE\n1,1,2,3,4\n2,2,5,6,3\n"
        "*USER ELEMENT, TYPE=U1, NODES=2\n*ELEMENT, TYPE=U1, ELSET=U\n7,1,2\n*SHELL SECTION, ELSET=PLATE\n0.1\n");
    CellBlock& quads = mesh.block(CellType::quad);
    const FamilyIndex family = quads.families[1];
    quads.connectivity.resize(4);
    quads.ids.resize(1);
    quads.families.resize(1);
    std::vector<CellRef> parts;
    parts.push_back({CellType::triangle, mesh.add_cell(CellType::triangle, std::array<Index, 3>{1, 4, 5}, 2, family)});
    parts.push_back({CellType::triangle, mesh.add_cell(CellType::triangle, std::array<Index, 3>{1, 5, 2}, 8, family)});
    fit_cards(mesh, parts);
    const auto& cards = solver_input(mesh)->cards();
    ASSERT_EQ(cards.size(), 6u);
    EXPECT_EQ(*cards[2].parameter("TYPE"), "S3");
    EXPECT_EQ(*cards[2].parameter("ELSET"), "PLATE");
    EXPECT_EQ(solver_input(mesh)->other_elements().at(0).card, 4u);
    write_inp(mesh, folder_ / "out.inp");
    std::ifstream in(folder_ / "out.inp");
    const std::string text(std::istreambuf_iterator<char>(in), {});
    EXPECT_THAT(text, testing::HasSubstr("*ELEMENT, TYPE=S4, ELSET=PLATE\n1,1,2,3,4\n*ELEMENT, TYPE=S3, ELSET=PLATE\n"
                                         "2, 2, 5, 6\n8, 2, 6, 3\n*USER"));
    const Mesh back = read_inp(folder_ / "out.inp");
    EXPECT_THAT(element_set(back, "PLATE"), testing::UnorderedElementsAre(1, 2, 8));
    fit_cards(mesh, parts);  // is done
    EXPECT_EQ(solver_input(mesh)->cards().size(), 6u);
}

}  // namespace
}  // namespace femscalpel::deck_testing
