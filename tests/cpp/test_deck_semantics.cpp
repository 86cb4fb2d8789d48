// SPDX-License-Identifier: LGPL-2.1-or-later
// What the cards of a deck say after an operator, checked against geometry: which nodes lie on the supported face,
// how large the loaded area is, what a linear temperature field is where a node now stands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include "deck/carry_over.h"
#include "deck/load_label.h"
#include "deck/mark_deck.h"
#include "deck/rules/mesh_cards.h"
#include "deck/rules/rules.h"
#include "deck/solver_element.h"
#include "deck/solver_input.h"
#include "deck_testing.h"
#include "io/inp.h"
#include "mesh/quality.h"
#include "operators/crack.h"
#include "tools/plane.h"

namespace femscalpel {
namespace {

using namespace deck_testing;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

TEST_F(DeckSemantics, SupportsByNumberReachCopiesAndNodesBornBetweenThem) {
    std::string cards = "*BOUNDARY\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) cards += std::to_string(node_at(i, j, 0)) + ", 1, 3\n";
    const Mesh mesh = block_with(cards);
    for (const double x : {1.5, 2.0, 2.3}) {
        SCOPED_TRACE(x);
        const Mesh after = crack_at(mesh, x, "CRACK", Vec3(1, .2, .1));
        std::map<Index, std::set<int>> held;
        for (const Row& r : rows(after, "BOUNDARY"))
            for (int dof = std::stoi(r[1]); dof <= std::stoi(r[2]); ++dof)
                EXPECT_TRUE(held[std::stoll(r[0])].insert(dof).second);
        const auto wanted = nodes_where(after, [](const Vec3& p) { return p.z() == 0; });
        EXPECT_GT(wanted.size(), 15u);
        EXPECT_EQ(held.size(), wanted.size());
        for (const Index n : wanted) EXPECT_THAT(held[n], ElementsAre(1, 2, 3)) << n;
    }
}

TEST_F(DeckSemantics, SupportsThatASetAndNumbersShareReachNodesBetweenThem) {
    // The set ends at x = 1, numbers go on: an edge between them is held at both ends.
    std::string cards = "*NSET, NSET=LEFT\n", numbers;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
            (i <= 1 ? cards : numbers) += std::to_string(node_at(i, j, 0)) + (i <= 1 ? "\n" : ", 3, 3\n");
    const Mesh after = crack_at(block_with(cards + "*BOUNDARY\nLEFT, 3, 3\n*BOUNDARY\n" + numbers), 1.5);
    std::set<Index> held;
    for (const Row& r : rows(after, "BOUNDARY"))
        for (const Index n : nodes_of(after, r[0])) held.insert(n);
    EXPECT_EQ(held, nodes_where(after, [](const Vec3& p) { return p.z() == 0; }));
}

TEST_F(DeckSemantics, PrescribedDisplacementsAreInterpolated) {
    // A rigid rotation about y: u_z = 0.1 x on the bottom, by number, with a value of its own per node.
    std::string cards = "*STEP\n*STATIC\n*BOUNDARY\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
            cards += std::to_string(node_at(i, j, 0)) + ", 3, 3, " + std::to_string(0.1 * i) + "\n";
    const Mesh after = crack_at(block_with(cards + "*END STEP\n"), 1.6);
    std::map<Index, double> value;
    for (const Row& r : rows(after, "BOUNDARY")) value[std::stoll(r[0])] = r.size() > 3 ? std::stod(r[3]) : 0;
    EXPECT_EQ(value.size(), nodes_where(after, [](const Vec3& p) { return p.z() == 0; }).size());
    for (const auto& [node, v] : value) EXPECT_NEAR(v, 0.1 * place(after, node).x(), 1e-12);
}

TEST_F(DeckSemantics, NodeFieldsAreInterpolatedWhereNodesAreNow) {
    std::string cards = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n*STEP\n*STATIC\n*TEMPERATURE\n";
    for (int k = 0; k <= nz; ++k)
        for (int j = 0; j <= ny; ++j)
            for (int i = 0; i <= nx; ++i)
                cards += std::to_string(node_at(i, j, k)) + ", " + std::to_string(i + 10 * j + 100 * k) + "\n";
    const Mesh mesh = block_with(cards + "*END STEP\n");
    const Mesh after = crack_at(mesh, 1.7, "CRACK", Vec3(1, .3, -.2));
    std::map<Index, double> t;
    for (const Row& r : rows(after, "TEMPERATURE")) t[std::stoll(r[0])] = std::stod(r[1]);
    ASSERT_EQ(t.size(), static_cast<std::size_t>(after.node_count()));
    for (const auto& [node, value] : t) EXPECT_NEAR(value, place(after, node).dot(Vec3(1, 10, 100)), 1e-9) << node;
    // What a set says for all needs no line.
    EXPECT_EQ(rows(after, "INITIALCONDITIONS").size(), 1u);
    EXPECT_THAT(warnings_, Not(Contains(HasSubstr("deck.inp"))));
}

TEST_F(DeckSemantics, ConcentratedLoadOnADoubledNodeStaysWholeAndIsReported) {
    const std::string line = std::to_string(node_at(2, 2, 2)) + ", 2, -7.5";
    const Mesh mesh = block_with("*STEP\n*STATIC\n*CLOAD\n" + line + "\n*END STEP\n");
    const Mesh after = crack_at(mesh, 2);
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre(std::to_string(node_at(2, 2, 2)), "2", "-7.5")));
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr(at_line(line)), HasSubstr("*CLOAD names node 43"),
                                          HasSubstr("negative side"))));
    // It is known what happens to it: strict accepts that.
    crack_at(mesh, 2, "CRACK", Vec3(1, 0, 0), true);
    // The original is on the negative side.
    std::set<Index> negative;
    for (const Index e : element_set(after, "EALL")) {
        const CellRef c = *NumberIndex(after).cell(e);
        if (cell_measure(after, c.type, c.cell) <= 0) continue;
        const auto n = after.block(c.type).nodes(c.cell);
        double x = 0;
        for (const Index v : n) x += after.points[v].x() / 4;
        if (x < 2)
            for (const Index v : n) negative.insert(after.node_ids[v]);
    }
    EXPECT_TRUE(negative.contains(node_at(2, 2, 2)));
}

TEST_F(DeckSemantics, LoadedNodesByNumberDoNotMove) {
    std::string cards = "*STEP\n*STATIC\n*CLOAD\n";
    for (int i = 0; i <= nx; ++i) cards += std::to_string(node_at(i, 2, 2)) + ", 2, " + std::to_string(i + 1) + ".\n";
    const Mesh after = crack_at(block_with(cards + "*END STEP\n"), 1.8, "CRACK", Vec3(1, .3, .2));
    for (int i = 0; i <= nx; ++i) EXPECT_EQ(place(after, node_at(i, 2, 2)), Vec3(i, 2, 2));
    EXPECT_EQ(rows(after, "CLOAD").size(), 5u);
}

TEST_F(DeckSemantics, LoadOnASetKeepsItsTotalAlsoUnderASecondCrack) {
    std::string cards = "*NSET, NSET=TOP\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) cards += std::to_string(node_at(i, j, 2)) + ",\n";
    const std::string line = "TOP, 3, -2.";
    const Mesh mesh = block_with(cards + "*STEP\n*STATIC\n*CLOAD\n" + line + "\n*CFLUX\nTOP, 11, 1.\n*END STEP\n");
    Mesh after = crack_at(mesh, 1.5);
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre("TOP_LOAD1", "3", "-2.")));
    EXPECT_THAT(rows(after, "CFLUX"), ElementsAre(ElementsAre("TOP_LOAD1", "11", "1.")));
    EXPECT_EQ(node_set(after, "TOP_LOAD1").size(), 15u);
    EXPECT_GT(node_set(after, "TOP").size(), 15u);
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr(at_line(line)), HasSubstr("TOP_LOAD1"))));

    // Without writing the deck in between: the set is known to be closed.
    CrackOptions options;
    options.name = "A";
    const Result first = crack(mesh, Plane(Vec3(1.5, 1, 1), Vec3(1, 0, 0)), options);
    options.name = "B";
    const Result second = crack(first.mesh, Plane(Vec3(2.5, 1, 1), Vec3(1, 0, 0)), options);
    EXPECT_THAT(rows(second.mesh, "CLOAD"), ElementsAre(ElementsAre("TOP_LOAD1", "3", "-2.")));
    EXPECT_EQ(node_set(second.mesh, "TOP_LOAD1").size(), 15u);
    // And with: then it is a set like others, and gets one of its own.
    after = crack_at(after, 2.5, "B");
    ASSERT_EQ(rows(after, "CLOAD").size(), 1u);
    EXPECT_EQ(node_set(after, rows(after, "CLOAD")[0][0]).size(), 15u);
}

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
            const Vec3 a = mesh.points[n[faces_of[face - 1][0]]], b = mesh.points[n[faces_of[face - 1][1]]],
                       d = mesh.points[n[faces_of[face - 1][2]]];
            for (const Vec3& p : {a, b, d}) EXPECT_NEAR(p.z(), 2, 1e-12) << keyword << " on a wrong face of " << e;
            out[r.back()] += (b - a).cross(d - a).norm() / 2;
        }
    }
    return out;
}

TEST_F(DeckSemantics, FaceLoadsReachAllPiecesAndKeepTheirArea) {
    // Pressure over part of the top (its border is no feature line), heat flux over all, film with two values.
    std::string pressure, flux, film;
    const Block b = block();
    for (const auto& [e, f] : top_faces()) {
        double x = 0, y = 0;
        for (const int v : faces_of[f - 1]) {
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

TEST_F(DeckSemantics, FaceLoadsBySetAndLabelReachAllPieces) {
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

TEST_F(DeckSemantics, BodyLoadsByNumberKeepTheirVolume) {
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

TEST_F(DeckSemantics, ElementValuesGoToAllParts) {
    std::string stress, distribution, change;
    for (int e = 1; e <= 96; ++e) {
        stress += std::to_string(e) + ", 1, " + std::to_string(e) + ".5, 0., 0., 0., 0., 0.\n";
        distribution += std::to_string(e) + ", 1., 0., 0., 0., 1., " + std::to_string(e) + ".\n";
        change += std::to_string(e) + (e % 8 == 0 ? "\n" : ", ");
    }
    const Mesh mesh = block_with("*DISTRIBUTION, NAME=D\n, 1., 0., 0., 0., 1., 0.\n" + distribution +
                                 "*DEPVAR\n8\n*INITIAL CONDITIONS, TYPE=STRESS\n" + stress +
                                 "*STEP\n*STATIC\n*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n" + change + "*END STEP\n");
    const Mesh after = crack_at(mesh, 1.6, "CRACK", Vec3(1, .3, .5));
    const std::vector<Index> all = element_set(after, "EALL");
    ASSERT_GT(all.size(), 96u);
    EXPECT_EQ(rows(after, "INITIALCONDITIONS").size(), all.size());
    EXPECT_EQ(rows(after, "DISTRIBUTION").size(), all.size() + 1);
    std::set<Index> changed;
    for (const Row& r : rows(after, "MODELCHANGE"))
        for (const std::string& entry : r) changed.insert(std::stoll(entry));
    EXPECT_EQ(changed, std::set<Index>(all.begin(), all.end()));
    // Parts have the value of the element they lie in.
    const NumberIndex old_numbers(mesh), new_numbers(after);
    std::map<double, double> volume;
    for (const Row& r : rows(after, "INITIALCONDITIONS")) {
        const CellRef c = *new_numbers.cell(std::stoll(r[0]));
        volume[std::stod(r[2])] += cell_measure(after, c.type, c.cell);
    }
    EXPECT_EQ(volume.size(), 96u);
    EXPECT_THAT(warnings_, Not(Contains(HasSubstr("deck.inp"))));
}

TEST_F(DeckSemantics, RecordsOverSeveralLinesStayTogether) {
    const Mesh mesh = block_with(
        "*DEPVAR\n8\n*INITIAL CONDITIONS, TYPE=SOLUTION\n"
        "9, 1, 1., 2., 3., 4., 5., 6.\n7., 8.\n10, 1, 11., 2., 3., 4., 5., 6.\n17., 18.\n");
    Mesh after = mesh;
    Changes changes;
    const CellBlock& tetras = after.block(CellType::tetra);
    const std::vector<Index> nodes(tetras.nodes(8).begin(), tetras.nodes(8).end());
    after.add_cell(CellType::tetra, nodes, 1000, tetras.families[8]);
    changes.parts.push_back({1000, 9});
    std::vector<std::string> warnings;
    carry_deck(mesh, after, changes, false, warnings);
    EXPECT_THAT(rows(after, "INITIALCONDITIONS"),
                ElementsAre(ElementsAre("9", "1", "1.", "2.", "3.", "4.", "5.", "6."), ElementsAre("7.", "8."),
                            ElementsAre("1000", "1", "1.", "2.", "3.", "4.", "5.", "6."), ElementsAre("7.", "8."),
                            ElementsAre("10", "1", "11.", "2.", "3.", "4.", "5.", "6."), ElementsAre("17.", "18.")));
}

TEST_F(DeckSemantics, EquationsStayWithTheOriginalsAndTheirNodesDoNotMove) {
    const std::string a = std::to_string(node_at(2, 0, 2)), b = std::to_string(node_at(1, 0, 2));
    const std::string line = a + ", 1, 1., " + b + ", 1, -1.";
    const Mesh mesh = block_with("*EQUATION\n2\n" + line + "\n");
    const Mesh untouched = crack_at(mesh, 1.6);
    EXPECT_EQ(place(untouched, node_at(2, 0, 2)), Vec3(2, 0, 2));
    EXPECT_EQ(place(untouched, node_at(1, 0, 2)), Vec3(1, 0, 2));
    EXPECT_THAT(warnings_, Not(Contains(HasSubstr("EQUATION"))));
    const Mesh after = crack_at(mesh, 2);
    EXPECT_THAT(rows(after, "EQUATION"), ElementsAre(ElementsAre("2"), ElementsAre(a, "1", "1.", b, "1", "-1.")));
    EXPECT_THAT(warnings_,
                Contains(AllOf(HasSubstr(at_line(line) + "*EQUATION names node " + a), HasSubstr("negative side"))));
    try {
        crack_at(mesh, 2, "CRACK", Vec3(1, 0, 0), true);
        FAIL() << "strict accepted a doubled term";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("strict"), HasSubstr(at_line(line))));
    }
}

TEST_F(DeckSemantics, SetsInEquationsKeepTheirSize) {
    std::string cards = "*NSET, NSET=A\n", other = "*NSET, NSET=B\n";
    for (int i = 0; i <= nx; ++i) {
        cards += std::to_string(node_at(i, 0, 2)) + "\n";
        other += std::to_string(node_at(i, 2, 2)) + "\n";
    }
    const Mesh mesh = block_with(cards + other + "*EQUATION\n3\nA, 1, 1., B, 1, -1.,\n13, 1, .5\n*CLOAD\nA, 1, 1.\n");
    const Mesh after = crack_at(mesh, 1.5, "CRACK", Vec3(1, 0, 0));
    EXPECT_THAT(rows(after, "EQUATION"),
                ElementsAre(ElementsAre("3"), ElementsAre("A_LOAD1", "1", "1.", "B_LOAD1", "1", "-1."),
                            ElementsAre("13", "1", ".5")));
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre("A_LOAD1", "1", "1.")));
    EXPECT_EQ(node_set(after, "A_LOAD1").size(), 5u);
    for (int i = 0; i <= nx; ++i) EXPECT_EQ(place(after, node_at(i, 0, 2)), Vec3(i, 0, 2));
}

TEST_F(DeckSemantics, PlanesOfMpcsTakeInNewNodesOthersAreReported) {
    std::string plane = "*MPC\nPLANE";
    int count = 0;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) plane += (count++ == 12 ? "\n0, " : ", ") + std::to_string(node_at(i, j, 2));
    const std::string line = "MEANROT, 33, 38, 43, 99";
    const Mesh mesh = block_with("*NODE\n99, 2., 1., 5.\n" + plane + "\n" + line + "\n");
    const Mesh after = crack_at(mesh, 2);
    std::set<Index> on_plane;
    for (const Row& r : rows(after, "MPC"))
        if (r[0] == "PLANE" || r[0] == "0")
            for (std::size_t k = 1; k < r.size(); ++k) on_plane.insert(std::stoll(r[k]));
    EXPECT_EQ(on_plane, nodes_where(after, [](const Vec3& p) { return p.z() == 2; }));
    EXPECT_EQ(rows(after, "MPC").back()[0], "MEANROT");
    EXPECT_THAT(warnings_,
                Contains(AllOf(HasSubstr(at_line(line)), HasSubstr("node 33 and 2 more"), HasSubstr("MEANROT"))));
}

TEST_F(DeckSemantics, ReferencesToDoubledNodesAreReported) {
    const std::string node = std::to_string(node_at(2, 1, 2));
    const std::string rigid = "*RIGID BODY, NSET=END, REF NODE=" + node,
                      coupling = "*COUPLING, CONSTRAINT NAME=C, SURFACE=S, REF NODE=" + node;
    const std::string film = "1, F1FC, " + node + ", 3.", weights = node + ", .5", kept = node + ", 1, 3";
    const Mesh mesh = block_with("*NSET, NSET=END\n1\n" + rigid + "\n" + coupling +
                                 "\n*KINEMATIC\n1, 3\n*DISTRIBUTING COUPLING, ELSET=EALL\n" + weights +
                                 "\n*STEP\n*STATIC\n*FILM\n" + film + "\n*RETAINED NODAL DOFS\n" + kept +
                                 "\n*RESTART, READ\n*VIEWFACTOR, READ\n*END STEP\n*NOTACARD\n*NOTACARD\n");
    crack_at(mesh, 2);
    for (const std::string& line :
         {rigid, coupling, film, weights, kept, std::string("*RESTART, READ"), std::string("*VIEWFACTOR, READ")})
        EXPECT_THAT(warnings_, Contains(HasSubstr(at_line(line)))) << line;
    EXPECT_EQ(std::ranges::count_if(warnings_, [](const std::string& w) { return w.find("NOTACARD") != w.npos; }), 1);
}

TEST_F(DeckSemantics, SubmodelNodesIncludeNewOnes) {
    std::string numbers;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) numbers += std::to_string(node_at(i, j, 0)) + (i < nx || j < ny ? ",\n" : "\n");
    const Mesh after = crack_at(block_with("*SUBMODEL, TYPE=NODE, INPUT=global.frd\n" + numbers), 1.5);
    std::set<Index> listed;
    for (const Row& r : rows(after, "SUBMODEL")) listed.insert(std::stoll(r[0]));
    EXPECT_EQ(listed, nodes_where(after, [](const Vec3& p) { return p.z() == 0; }));
}

TEST_F(DeckSemantics, OtherElementsKeepTheirNodesAndAreReported) {
    const std::string node = std::to_string(node_at(2, 1, 2));
    const Mesh mesh = block_with(
        "*USER ELEMENT, TYPE=US3, NODES=2, INTEGRATION POINTS=1, MAXDOF=3\n*ELEMENT, TYPE=US3, ELSET=U\n500, " + node +
        ", 1\n");
    ASSERT_EQ(solver_input(mesh)->other_elements().size(), 1u);
    crack_at(mesh, 2);
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr("node " + node), HasSubstr("element 500 of type US3"))));
}

/// A sheet 4 x 2 of shell triangles; node numbers 1 + i + 5 j, elements 1 to 16.
std::string sheet(const std::string& type) {
    std::ostringstream out;
    out << "*NODE, NSET=NALL\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) out << 1 + i + 5 * j << ", " << i << ", " << j << ", 1\n";
    out << "*ELEMENT, TYPE=" << type << ", ELSET=EALL\n";
    int e = 0;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const int a = 1 + i + 5 * j;
            out << e + 1 << ", " << a << ", " << a + 1 << ", " << a + 6 << "\n"
                << e + 2 << ", " << a << ", " << a + 6 << ", " << a + 5 << "\n";
            e += 2;
        }
    return out.str();
}

TEST_F(DeckSemantics, ShellNormalsThicknessesAndEdgeLoads) {
    std::string normals = "*NORMAL\n", thickness = "*NODAL THICKNESS\n", pressure, edges, film;
    for (int e = 1; e <= 16; ++e) pressure += std::to_string(e) + ", P, 2.\n";
    for (int e = 1; e <= 16; ++e) film += std::to_string(e) + ", FPOS, 20., 3.\n";
    for (const int e : {1, 3, 5, 7}) edges += std::to_string(e) + ", EDNOR1, 3.\n";  // y = 0
    for (int n = 1; n <= 15; ++n) thickness += std::to_string(n) + ", " + std::to_string(1 + (n - 1) % 5) + "\n";
    normals += "3, 3, 0., 0., 1.\n";
    const Mesh mesh = read(sheet("S3") + thickness + normals + "*STEP\n*STATIC\n*DLOAD\n" + pressure + edges +
                           "*FILM\n" + film + "*END STEP\n");
    for (const double x : {1.5, 2.0, 2.3}) {
        SCOPED_TRACE(x);
        const Mesh after = crack_at(mesh, x, "CRACK", Vec3(1, .2, 0));
        const NumberIndex numbers(after);
        double area = 0, length = 0, film_area = 0;
        for (const Row& r : rows(after, "DLOAD")) {
            const CellRef c = *numbers.cell(std::stoll(r[0]));
            if (r[1] == "P") {
                area += cell_measure(after, c.type, c.cell);
                continue;
            }
            const int k = LoadLabel(r[1]).number - 1;
            const auto n = after.block(c.type).nodes(c.cell);
            const Vec3 a = after.points[n[k]], b = after.points[n[(k + 1) % 3]];
            EXPECT_EQ(a.y(), 0);
            EXPECT_EQ(b.y(), 0);
            length += (b - a).norm();
        }
        for (const Row& r : rows(after, "FILM")) {
            const CellRef c = *numbers.cell(std::stoll(r[0]));
            film_area += cell_measure(after, c.type, c.cell);
        }
        EXPECT_NEAR(area, 8, 1e-12);
        EXPECT_NEAR(film_area, 8, 1e-12);
        EXPECT_NEAR(length, 4, 1e-12);
        std::map<Index, double> t;
        for (const Row& r : rows(after, "NODALTHICKNESS")) t[std::stoll(r[0])] = std::stod(r[1]);
        EXPECT_EQ(t.size(), static_cast<std::size_t>(after.node_count()));
        for (const auto& [node, value] : t) EXPECT_NEAR(value, 1 + place(after, node).x(), 1e-12);
        // The normal holds for every part of element 3 at every node that stands where node 3 stood.
        EXPECT_GE(rows(after, "NORMAL").size(), 1u);
        for (const Row& r : rows(after, "NORMAL")) {
            const CellRef c = *numbers.cell(std::stoll(r[0]));
            const auto n = after.block(c.type).nodes(c.cell);
            const Index node = *numbers.node(std::stoll(r[1]));
            EXPECT_NE(std::ranges::find(n, node), n.end());
            EXPECT_EQ(after.points[node], Vec3(2, 0, 1));
        }
    }
}

TEST_F(DeckSemantics, PlaneElementsCountTheirEdgesDifferently) {
    std::string edges;
    for (const int e : {1, 3, 5, 7}) edges += std::to_string(e) + ", P1, 3.\n";  // y = 0
    const Mesh mesh = read(sheet("CPS3") + "*STEP\n*STATIC\n*DLOAD\n" + edges + "*END STEP\n");
    const Mesh after = crack_at(mesh, 1.5, "CRACK", Vec3(1, .2, 0));
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

TEST_F(DeckSemantics, WhatIsRemovedIsReportedAndLeavesItsCards) {
    const std::string top = std::to_string(top_faces()[0].first);
    const std::string lines[] = {
        "45, 1, 1.",           "GONE, 2, 1.", top + ", P" + std::to_string(top_faces()[0].second) + ", 5.",
        top + ", BF, 1.",      "45, 1, 3",    "45, 300.",
        "45, 1, 1., 1, 1, -1."};
    const Mesh mesh =
        block_with("*NSET, NSET=GONE\n45, 1\n*BOUNDARY\n" + lines[4] + "\n*EQUATION\n2\n" + lines[6] +
                   "\n*RIGID BODY, NSET=GONE, REF NODE=45\n*STEP\n*STATIC\n*CLOAD\n" + lines[0] + "\n" + lines[1] +
                   "\n*DLOAD\n" + lines[2] + "\n" + lines[3] + "\n*TEMPERATURE\n" + lines[5] + "\n*END STEP\n");
    const DeckMarks marks = mark_deck(mesh);
    ASSERT_TRUE(marks.mesh);
    // Node 45 goes, and every element that needs it, and the loaded one.
    Mesh after = *marks.mesh;
    const Index gone = *NumberIndex(after).node(45);
    CellBlock& tetras = after.block(CellType::tetra);
    std::vector<Index> shift(static_cast<std::size_t>(tetras.size()), -1);
    CellBlock left;
    left.type = tetras.type;
    for (Index c = 0; c < tetras.size(); ++c) {
        const auto n = tetras.nodes(c);
        if (std::ranges::find(n, gone) != n.end() || std::to_string(tetras.ids[c]) == top) continue;
        shift[c] = left.size();
        left.connectivity.insert(left.connectivity.end(), n.begin(), n.end());
        left.ids.push_back(tetras.ids[c]);
        left.families.push_back(tetras.families[c]);
    }
    tetras = left;
    std::erase_if(after.facets, [&](const Facet& f) { return shift[f.cell] < 0; });
    for (Facet& f : after.facets) f.cell = shift[f.cell];
    ASSERT_EQ(gone, after.node_count() - 1);
    after.points.pop_back();
    after.node_ids.pop_back();
    after.node_families.pop_back();
    std::vector<std::string> warnings;
    Mesh strict = after;
    carry_deck(*marks.mesh, after, {}, false, warnings);
    for (const std::string& line : lines) EXPECT_THAT(warnings, Contains(HasSubstr(at_line(line)))) << line;
    EXPECT_THAT(warnings, Contains(HasSubstr("REF NODE")));
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre("GONE", "2", "1.")));
    EXPECT_THAT(rows(after, "DLOAD"), IsEmpty());
    EXPECT_THAT(rows(after, "BOUNDARY"), IsEmpty());
    EXPECT_THAT(rows(after, "TEMPERATURE"), IsEmpty());
    EXPECT_THROW(carry_deck(*marks.mesh, strict, {}, true, warnings), Error);
}

TEST_F(DeckSemantics, LinesKeepTheirPlaceAndNewOnesSayWhereTheyAreFrom) {
    std::string cards = "*BOUNDARY\n** the bottom\n";
    for (int i = 0; i <= nx; ++i) cards += std::to_string(node_at(i, 0, 0)) + ", 1, 1\n";
    const std::string last = std::to_string(node_at(nx, 0, 0)) + ", 1, 1";
    const Mesh mesh = block_with(cards + "** end of the bottom\n*STEP\n*STATIC\n*END STEP\n");
    const Result result = crack(mesh, Plane(Vec3(1.5, 1, 1), Vec3(1, 0, 0)));
    for (const Card& card : solver_input(result.mesh)->cards()) {
        if (card.keyword != "BOUNDARY") continue;
        std::string text;
        for (const DeckText& t : card.text) text += t.text;
        EXPECT_TRUE(text.starts_with(cards)) << text;
        EXPECT_TRUE(text.ends_with("\n** end of the bottom\n")) << text;
        CardReader line(card);
        std::vector<std::string> places;
        while (line.next_data_line()) places.push_back(line.where());
        ASSERT_GT(places.size(), 5u);
        EXPECT_THAT(places[4], HasSubstr(at_line(last)));
        EXPECT_THAT(places[5], HasSubstr("deck.inp:" + std::to_string(line_of(last)) + " (carried over):1: "));
    }
}

TEST_F(DeckSemantics, CardsThatNameNothingTouchedKeepTheirText) {
    const std::string cards =
        "*BOUNDARY\n1, 1, 3\n*TRANSFORM, NSET=NALL, TYPE=C\n0.,0.,0.,0.,0.,1.\n*ORIENTATION, "
        "NAME=OR\n1.,0.,0.,0.,1.,0.\n"
        "*STEP\n*STATIC\n*CLOAD\n1, 2, 3.\n*DLOAD\nEALL, GRAV, 9.81, 0., 0., -1.\n*NODE PRINT, NSET=NALL\nU\n*EL "
        "PRINT, ELSET=EALL\nS\n*END STEP\n";
    const Mesh mesh = block_with(cards);
    const Result result = crack(mesh, Plane(Vec3(2.5, 1, 1), Vec3(1, 0, 0)));
    std::string text;
    for (const Card& card : solver_input(result.mesh)->cards())
        if (!is_mesh_card(card))
            for (const DeckText& t : card.text) text += t.text;
    EXPECT_EQ(text, cards);
    EXPECT_EQ(result.mesh.companion, mesh.companion);
}

TEST_F(DeckSemantics, SurfacesOfTiesContactAndLoadsFollow) {
    const auto on_top = [](const Vec3& p) { return p.z() == nz; };
    const auto on_end = [](const Vec3& p) { return p.x() == nx; };
    std::string top = "*SURFACE, NAME=TOP, TYPE=ELEMENT\n", end = "*SURFACE, NAME=END\n",
                nodes = "*SURFACE, NAME=BOTTOM, TYPE=NODE\n", set;
    for (const auto& [e, f] : top_faces()) top += std::to_string(e) + ", S" + std::to_string(f) + "\n";
    const Block b = block();
    for (std::size_t e = 0; e < b.tetras.size(); ++e)
        for (int f = 0; f < 4; ++f)
            if (std::ranges::all_of(faces_of[f], [&](int v) { return b.tetras[e][v] % (nx + 1) == 0; }))
                end += std::to_string(e + 1) + ", S" + std::to_string(f + 1) + "\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            nodes += std::to_string(node_at(i, j, 0)) + "\n";
            set += std::to_string(node_at(i, j, 2)) + ",\n";
        }
    const std::string naming =
        "*TIE, NAME=T1, POSITION TOLERANCE=.01\nBOTTOM, TOP\n*SURFACE INTERACTION, NAME=SI\n*SURFACE BEHAVIOR, "
        "PRESSURE-OVERCLOSURE=HARD\n"
        "*CONTACT PAIR, INTERACTION=SI, TYPE=NODE TO SURFACE\nHELD, TOP\n*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE "
        "TO SURFACE\nTOP, END\n"
        "*COUPLING, CONSTRAINT NAME=C1, SURFACE=TOP, REF NODE=900\n*KINEMATIC\n1, 3\n"
        "*STEP\n*STATIC\n*DSLOAD\nEND, P, 2.\n*SECTION PRINT, SURFACE=END, NAME=SP\nSOF\n*FACE PRINT, "
        "SURFACE=END\nSOF\n*CONTACT PRINT\nCDIS\n*END STEP\n";
    const Mesh mesh = block_with("*NODE\n900, 9., 9., 9.\n" + top + end + nodes + "*NSET, NSET=HELD_N\n" + set +
                                 "*SURFACE, NAME=HELD, TYPE=NODE\nHELD_N\n" + naming);
    ASSERT_NEAR(surface_area(mesh, "TOP", on_top), nx * ny, 1e-12);
    for (const double x : {1.5, 2.0, 2.3})
        for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(1, .3, .4), Vec3(.3, 1, .2)}) {
            SCOPED_TRACE(x);
            const Mesh after = crack_at(mesh, x, "CRACK", normal, true);  // strict: all of this is understood
            EXPECT_THAT(warnings_, Not(Contains(HasSubstr("deck.inp"))));
            EXPECT_NEAR(surface_area(after, "TOP", on_top), nx * ny, 1e-12);
            EXPECT_NEAR(surface_area(after, "END", on_end), ny * nz, 1e-12);
            for (const auto& [name, z] : {std::pair("BOTTOM", 0), std::pair("HELD", nz), std::pair("HELD_N", nz)}) {
                const auto found = node_set(after, name);
                EXPECT_EQ(std::set<Index>(found.begin(), found.end()),
                          nodes_where(after, [&](const Vec3& p) { return p.z() == z; }))
                    << name;
            }
            // The cards that name them say what they said.
            for (const char* keyword :
                 {"TIE", "CONTACTPAIR", "COUPLING", "KINEMATIC", "DSLOAD", "SECTIONPRINT", "FACEPRINT", "CONTACTPRINT"})
                EXPECT_EQ(text_of(after, keyword), text_of(mesh, keyword)) << keyword;
        }
}

TEST_F(DeckSemantics, DiscreteElementsStayWholeInTheirSetsAndAreReported) {
    // Two of each at nodes that are doubled: masses, springs to ground and between nodes, dashpots, gaps.
    const auto at = [](int j, int k) { return std::to_string(node_at(2, j, k)); };
    const std::string right = std::to_string(node_at(4, 2, 0)), left = std::to_string(node_at(0, 2, 0));
    const Mesh mesh =
        block_with("*ELEMENT, TYPE=MASS, ELSET=M\n901, " + at(0, 0) + "\n902, " + at(2, 2) +
                   "\n*MASS, ELSET=M\n1.\n"
                   "*ELEMENT, TYPE=SPRING1, ELSET=G\n903, " +
                   at(0, 1) + "\n904, " + at(1, 1) +
                   "\n*SPRING, ELSET=G\n1\n5.\n"
                   "*ELEMENT, TYPE=SPRINGA, ELSET=S\n905, " +
                   at(0, 2) + ", " + right + "\n906, " + left + ", " + at(1, 2) +
                   "\n*SPRING, ELSET=S\n\n5.\n"
                   "*ELEMENT, TYPE=DASHPOTA, ELSET=D\n907, " +
                   right + ", " + at(2, 0) + "\n908, " + at(1, 0) + ", " + left +
                   "\n*DASHPOT, ELSET=D\n\n5.\n"
                   "*ELEMENT, TYPE=GAPUNI, ELSET=U\n909, " +
                   at(2, 1) + ", " + right + "\n910, " + at(0, 0) + ", " + left + "\n*GAP, ELSET=U\n0., 1., 0., 0.\n");
    const Mesh after = crack_at(mesh, 2, "CRACK", Vec3(1, 0, 0), true);
    for (const auto& [name, first] :
         {std::pair("M", 901), std::pair("G", 903), std::pair("S", 905), std::pair("D", 907), std::pair("U", 909)})
        EXPECT_THAT(element_set(after, name), ElementsAre(first, first + 1)) << name;
    for (const char* keyword : {"MASS", "SPRING", "DASHPOT", "GAP"})
        EXPECT_EQ(text_of(after, keyword), text_of(mesh, keyword));
    // On which side a node is: where the solid elements that have it lie.
    std::map<Index, double> middle;
    const CellBlock& tetras = after.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c)
        for (const Index n : tetras.nodes(c))
            for (const Index m : tetras.nodes(c)) middle[after.node_ids[n]] += after.points[m].x() - 2;
    const NumberIndex numbers(after), old_numbers(mesh);
    for (Index e = 901; e <= 910; ++e) {
        const CellRef now = *numbers.cell(e), before = *old_numbers.cell(e);
        const auto n = after.block(now.type).nodes(now.cell), o = mesh.block(before.type).nodes(before.cell);
        std::set<bool> sides;
        for (std::size_t k = 0; k < n.size(); ++k) {
            EXPECT_EQ(after.points[n[k]], mesh.points[o[k]]) << "element " << e;
            sides.insert(middle.at(after.node_ids[n[k]]) > 0);
        }
        EXPECT_EQ(sides.size(), 1u) << "element " << e << " bridges the crack";
    }
    EXPECT_THAT(warnings_, Contains(HasSubstr("4 point element(s)")));
    EXPECT_THAT(warnings_, Contains(HasSubstr("6 segment element(s)")));
}

TEST_F(DeckSemantics, SetsOfTransformsRigidBodiesAndRequestsTakeInNewNodes) {
    std::string set = "*NSET, NSET=BOTTOM\n", velocity, displacement;
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            const std::string node = std::to_string(node_at(i, j, 0));
            set += node + ",\n";
            velocity += node + ", 2, " + std::to_string(i) + ".\n";
            displacement += node + ", 1, 0.25\n";
        }
    const std::string cards =
        "*TRANSFORM, NSET=BOTTOM, TYPE=C\n0.,0.,0.,0.,0.,1.\n*RIGID BODY, NSET=BOTTOM, REF NODE=900\n"
        "*STEP\n*STATIC\n*BOUNDARY\nBOTTOM, 1, 3\n*NODE PRINT, NSET=BOTTOM, TOTALS=YES\nRF\n*EL PRINT, ELSET=EALL, "
        "TOTALS=ONLY\nELSE\n"
        "*NODE FILE, NSET=BOTTOM\nU\n*EL FILE\nS\n*NODE OUTPUT\nU\n*ELEMENT OUTPUT\nS\n*END STEP\n";
    const Mesh mesh = block_with("*NODE\n900, 9., 9., 9.\n" + set + "*INITIAL CONDITIONS, TYPE=VELOCITY\n" + velocity +
                                 "*INITIAL CONDITIONS, TYPE=DISPLACEMENT\n" + displacement + cards);
    const Mesh after = crack_at(mesh, 1.6, "CRACK", Vec3(1, .3, .1), true);
    const auto wanted = nodes_where(after, [](const Vec3& p) { return p.z() == 0; });
    ASSERT_GT(wanted.size(), 15u);
    const auto found = node_set(after, "BOTTOM");
    EXPECT_EQ(std::set<Index>(found.begin(), found.end()), wanted);
    EXPECT_EQ(element_set(after, "EALL").size(), static_cast<std::size_t>(after.block(CellType::tetra).size()));
    for (const char* keyword : {"TRANSFORM", "RIGIDBODY", "BOUNDARY", "NODEPRINT", "ELPRINT", "NODEFILE", "ELFILE",
                                "NODEOUTPUT", "ELEMENTOUTPUT"})
        EXPECT_EQ(text_of(after, keyword), text_of(mesh, keyword)) << keyword;
    // Initial velocities 1 per unit of x, and displacements, at every node that is there now.
    std::map<Index, double> v, u;
    for (const Row& r : rows(after, "INITIALCONDITIONS")) (r[1] == "2" ? v : u)[std::stoll(r[0])] = std::stod(r[2]);
    EXPECT_EQ(v.size(), wanted.size());
    EXPECT_EQ(u.size(), wanted.size());
    for (const auto& [node, value] : v) EXPECT_NEAR(value, place(after, node).x(), 1e-9);
    for (const auto& [node, value] : u) EXPECT_EQ(value, 0.25);
}

TEST_F(DeckSemantics, StrictRefusesEveryCardThatCannotFollow) {
    const std::string node = std::to_string(node_at(2, 1, 2)), other = std::to_string(node_at(0, 1, 2));
    const std::pair<const char*, std::string> cards[] = {
        {"EQUATION", "*EQUATION\n2\n" + node + ", 1, 1., " + other + ", 1, -1.\n"},
        {"MPC", "*MPC\nBEAM, " + node + ", " + other + "\n"},
        {"RIGID BODY", "*NSET, NSET=R\n1\n*RIGID BODY, NSET=R, REF NODE=" + node + "\n"},
        {"COUPLING", "*SURFACE, NAME=S, TYPE=ELEMENT\n1, S1\n*COUPLING, CONSTRAINT NAME=C, SURFACE=S, REF NODE=" +
                         node + "\n*KINEMATIC\n1, 3\n"},
        {"DISTRIBUTING COUPLING", "*DISTRIBUTING COUPLING, ELSET=EALL\n" + node + ", 1.\n"},
        {"RESTART", "*STEP\n*STATIC\n*RESTART, READ\n*END STEP\n"},
        {"an unknown card", "*NOTACARD\n" + node + ", 1\n"},
    };
    for (const auto& [name, text] : cards) {
        SCOPED_TRACE(name);
        const Mesh mesh = block_with(text);
        crack_at(mesh, 2);
        EXPECT_THAT(warnings_, Contains(HasSubstr("deck.inp:")));
        EXPECT_THROW(crack_at(mesh, 2, "CRACK", Vec3(1, 0, 0), true), Error);
    }
}

TEST(LoadLabels, AreTakenApart) {
    EXPECT_EQ(LoadLabel("P3").number, 3);
    EXPECT_EQ(LoadLabel("p2nu").suffix, "NU");
    EXPECT_EQ(LoadLabel("F1FC").with_face(4, false), "F4FC");
    EXPECT_EQ(LoadLabel("EDNOR2").face(CellType::triangle, false), 4);
    EXPECT_EQ(LoadLabel("EDNOR2").with_face(5, false), "EDNOR3");
    EXPECT_EQ(LoadLabel("P2").face(CellType::triangle, true), 4);
    EXPECT_EQ(LoadLabel("P2").with_face(5, true), "P3");
    EXPECT_EQ(LoadLabel("P5").face(CellType::tetra, false), 0);
    EXPECT_EQ(LoadLabel("P1").face(CellType::line, false), 0);
    for (const char* whole : {"GRAV", "CENTRIF", "BF", "P", "SPOS", "FNEG", "NEWTON"})
        EXPECT_EQ(LoadLabel(whole).number, 0) << whole;
}

TEST(CardContents, EveryCardOfCalculixsDecksIsKnown) {
    const fs::path decks = "/usr/share/doc/calculix-ccx-test/examples/test";
    if (!fs::exists(decks)) GTEST_SKIP() << "Debian package calculix-ccx-test is not installed";
    const CardRules rules;
    std::set<std::string> unknown;
    for (const auto& entry : fs::directory_iterator(decks)) {
        const std::string name = entry.path().filename();
        if (!name.ends_with(".inp") && !name.ends_with(".inp.gz")) continue;
        if (entry.file_size() > 100000) continue;
        Mesh mesh;
        try {
            mesh = read_inp(entry.path());
        } catch (const Error&) {
            continue;
        }
        for (const Card& card : solver_input(mesh)->cards())
            if (!rules.find(card)) unknown.insert(card.keyword + " in " + name);
    }
    EXPECT_THAT(unknown, ElementsAre("MEMBRANE in c3d6.inp"));  // CalculiX does not know it either
}

}  // namespace
}  // namespace femscalpel
