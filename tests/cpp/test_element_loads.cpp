// SPDX-License-Identifier: LGPL-2.1-or-later
#include <map>
#include "deck/load_label.h"
#include "mesh/quality.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class ElementLoadsRule : public RuleTest {};

/// Area of the loaded faces per value, all of them checked to lie on z = 2.
std::map<std::string, double> loaded_area(const Mesh& mesh, const std::string& keyword) {
    std::map<std::string, double> out;
    const NumberIndex numbers(mesh);
    std::set<std::pair<Index, int>> seen;
    for (const Row& r : rows(mesh, keyword)) {
        const int face = LoadLabel(r[1]).number;
        for (const Index e : is_number(r[0]) ? std::vector<Index>{std::stoll(r[0])} : element_set(mesh, r[0])) {
            EXPECT_TRUE(seen.insert({e, face}).second) << e << " is loaded twice";
            const CellRef c = *numbers.cell(e);
            const auto n = mesh.block(c.type).nodes(c.cell);
            const Vec3 a = mesh.points[n[solver_faces[face - 1][0]]], b = mesh.points[n[solver_faces[face - 1][1]]],
                       d = mesh.points[n[solver_faces[face - 1][2]]];
            for (const Vec3& p : {a, b, d}) EXPECT_NEAR(p.z(), 2, 1e-12) << keyword << " on a wrong face of " << e;
            out[r.back()] += (b - a).cross(d - a).norm() / 2;
        }
    }
    return out;
}

TEST_F(ElementLoadsRule, FaceLoadsReachAllPiecesAndKeepTheirArea) {
    // Pressure over part of the top (its border is no feature line), heat flux over all, film with two values.
    std::string pressure, flux, film;
    const Block b = block();
    for (const auto& [e, f] : top_faces()) {
        double x = 0, y = 0;
        for (const int v : solver_faces[f - 1]) {
            x += static_cast<double>((b.tetras[e - 1][v] - 1) % 5) / 3;
            y += static_cast<double>((b.tetras[e - 1][v] - 1) / 5 % 3) / 3;
        }
        const std::string face = std::to_string(f);
        if (x < 3 && y < 1) pressure += std::to_string(e) + ", P" + face + ", 5.\n";
        flux += std::to_string(e) + ", S" + face + ", 1.\n";
        film += std::to_string(e) + ", F" + face + ", 20., " + (x < 2 ? "3." : "4.") + "\n";
    }
    const Mesh mesh =
        block_with("*STEP\n*STATIC\n*DLOAD\n" + pressure + "*DFLUX\n" + flux + "*FILM\n" + film + "*END STEP\n");
    const auto area = loaded_area(mesh, "DLOAD");
    EXPECT_NEAR(area.at("5."), 3, 1e-12);
    for (const double x : {1.5, 2.0, 2.35})
        for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(1, .3, .4), Vec3(.3, 1, .2)}) {
            SCOPED_TRACE(x);
            const Mesh after = crack_at(mesh, x, "CRACK", normal);
            for (const char* keyword : {"DLOAD", "DFLUX", "FILM"}) {
                const auto before_area = loaded_area(mesh, keyword), after_area = loaded_area(after, keyword);
                ASSERT_EQ(before_area.size(), after_area.size());
                for (const auto& [value, a] : before_area)
                    EXPECT_NEAR(after_area.at(value), a, 1e-12) << keyword << value;
            }
            EXPECT_THAT(warnings_, Not(Contains(HasSubstr("deck.inp"))));
        }
}

TEST_F(ElementLoadsRule, FaceLoadsBySetAndLabelReachAllPieces) {
    std::map<int, std::string> sets;
    for (const auto& [e, f] : top_faces()) sets[f] += std::to_string(e) + "\n";
    std::string define, load;
    for (const auto& [f, members] : sets) {
        define += "*ELSET, ELSET=TOP_S" + std::to_string(f) + "\n" + members;
        load += "TOP_S" + std::to_string(f) + ", P" + std::to_string(f) + ", 5.\n";
    }
    const Mesh mesh =
        block_with(define + "*STEP\n*STATIC\n*DLOAD\n" + load + "EALL, GRAV, 9.81, 0., 0., -1.\n*END STEP\n");
    const Mesh after = crack_at(mesh, 1.5, "CRACK", Vec3(1, .3, .4));
    const auto is_pressure = [](const Row& r) { return r[1].starts_with("P"); };
    Mesh pressure_only = after;
    auto deck = std::make_shared<SolverInput>(*solver_input(after));
    for (Card& card : deck->cards())
        if (card.keyword == "DLOAD") {
            std::string text = "*DLOAD\n";
            for (const Row& r : rows(after, "DLOAD"))
                if (is_pressure(r))
                    text += r[0] + "," + r[1] + "," + r[2] + "\n";
                else
                    EXPECT_THAT(r, ElementsAre("EALL", "GRAV", "9.81", "0.", "0.", "-1."));
            card.set_text(text);
        }
    pressure_only.companion = deck;
    EXPECT_NEAR(loaded_area(pressure_only, "DLOAD").at("5."), 8, 1e-12);
}

TEST_F(ElementLoadsRule, BodyLoadsByNumberKeepTheirVolume) {
    std::string cards = "*STEP\n*STATIC\n*DLOAD\n";
    for (int e = 1; e <= 48; ++e) cards += std::to_string(e) + ", GRAV, 9.81, 0., 0., -1.\n";  // z < 1
    const Mesh mesh = block_with(cards + "*END STEP\n");
    const Mesh after = crack_at(mesh, 1.6, "CRACK", Vec3(1, .3, .5));
    const NumberIndex numbers(after);
    double volume = 0;
    std::set<std::string> seen;
    for (const Row& r : rows(after, "DLOAD")) {
        EXPECT_TRUE(seen.insert(r[0]).second);
        const CellRef c = *numbers.cell(std::stoll(r[0]));
        volume += cell_measure(after, c.type, c.cell);
        EXPECT_EQ(r[1], "GRAV");
    }
    EXPECT_NEAR(volume, 8, 1e-12);
    EXPECT_GT(seen.size(), 48u);
}

TEST_F(ElementLoadsRule, PlaneElementsCountTheirEdgesDifferently) {
    // Forces hold the nodes at y = 0, so that an edge has to be divided there.
    std::string edges, forces;
    for (const int e : {1, 3, 5, 7}) edges += std::to_string(e) + ", P1, 3.\n";
    for (int n = 1; n <= 5; ++n) forces += std::to_string(n) + ", 1, 1.\n";
    const Mesh mesh = read(sheet("CPS3") + "*STEP\n*STATIC\n*CLOAD\n" + forces + "*DLOAD\n" + edges + "*END STEP\n");
    const Mesh after = crack_at(mesh, 1.3, "CRACK", Vec3(1, .2, 0));
    EXPECT_EQ(rows(after, "DLOAD").size(), 5u);
    const NumberIndex numbers(after);
    double length = 0;
    for (const Row& r : rows(after, "DLOAD")) {
        const CellRef c = *numbers.cell(std::stoll(r[0]));
        const int k = LoadLabel(r[1]).number - 1;
        const auto n = after.block(c.type).nodes(c.cell);
        length += (after.points[n[k]] - after.points[n[(k + 1) % 3]]).norm();
        EXPECT_EQ(after.points[n[k]].y() + after.points[n[(k + 1) % 3]].y(), 0);
    }
    EXPECT_NEAR(length, 4, 1e-12);
}

TEST(LoadLabels, AreTakenApart) {
    EXPECT_EQ(LoadLabel("P3").number, 3);
    EXPECT_EQ(LoadLabel("p2nu").suffix, "NU");
    EXPECT_EQ(LoadLabel("F1FC").with_face(4, CellType::tetra, false), "F4FC");
    EXPECT_EQ(LoadLabel("EDNOR2").face(CellType::triangle, false), 4);
    EXPECT_EQ(LoadLabel("EDNOR2").with_face(5, CellType::triangle, false), "EDNOR3");
    EXPECT_EQ(LoadLabel("P2").face(CellType::triangle, true), 4);
    EXPECT_EQ(LoadLabel("P2").with_face(5, CellType::triangle, true), "P3");
    EXPECT_EQ(LoadLabel("P5").face(CellType::tetra, false), 0);
    EXPECT_EQ(LoadLabel("P3").face(CellType::pyramid, false), 2);
    EXPECT_EQ(LoadLabel("P2").face(CellType::pyramid, false), 0);
    EXPECT_EQ(LoadLabel("P1").with_face(2, CellType::pyramid, false), "P3");
    EXPECT_EQ(LoadLabel("P1").face(CellType::line, false), 0);
    for (const char* whole : {"GRAV", "CENTRIF", "BF", "P", "SPOS", "FNEG", "NEWTON"})
        EXPECT_EQ(LoadLabel(whole).number, 0) << whole;
}

TEST_F(ElementLoadsRule, MarkFacesAndElementsThatAreLoadedAlike) {
    EXPECT_THAT(
        marked("*ELSET, ELSET=E\n1, 2\n*DLOAD\n1, P1, 5.\n2, P3, 5.\n1, P2, 6.\nE, P4, 7.\n2, BX, 1.\nEALL, GRAV, "
               "9.81, 0., 0., -1.\n"),
        UnorderedElementsAre(ElementsAre(11, 23), ElementsAre(12), ElementsAre(14, 24), ElementsAre(2)));
}

TEST_F(ElementLoadsRule, PartsOfFacesAndElementsGetTheLoad) {
    const Carried after =
        carried("*DLOAD\n1, P1, 5.\n1, P4, 6.\n1, P3, 7.\n1, BX, 2.\n2, P1, 8.\nEALL, GRAV, 9.81, 0., 0., -1.\n",
                halve_element_1);
    EXPECT_EQ(after.cards,
              "*DLOAD\n1, P1, 5.\n3, P1, 5.\n1, P4, 6.\n3, P3, 7.\n1, BX, 2.\n3, BX, 2.\n2, P1, 8.\nEALL, GRAV, 9.81, "
              "0., 0., "
              "-1.\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(ElementLoadsRule, SetsWithPartsAreNamedByNumber) {
    const Carried after = carried("*ELSET, ELSET=E\n1\n*FILM\nE, F3, 20., 3.\n", halve_element_1);
    EXPECT_EQ(after.cards, "*ELSET, ELSET=E\n1\n*FILM\n3, F3, 20., 3.\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(ElementLoadsRule, RemovedElementsTakeTheirLoadsWithThem) {
    const Carried after = carried("*DFLUX\n1, S1, 3.\n2, S2, 3.\n2, BF, 4.\n", remove_element_2);
    EXPECT_EQ(after.cards, "*DFLUX\n1, S1, 3.\n");
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:13: *DFLUX names element 2, which was removed, and with it its BF",
                            "deck.inp:12: *DFLUX names element 2, which was removed, and with it its S2"));
}

TEST_F(ElementLoadsRule, SinksOfFilmsStayTheOriginals) {
    const Carried after = carried("*FILM\n1, F1FC, 2, 3.\n", double_node_2);
    EXPECT_EQ(after.cards, "*FILM\n1, F1FC, 2, 3.\n");
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:11: *FILM names node 2, which the crack doubled; the original, on the "
                            "negative side, stays the sink"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
