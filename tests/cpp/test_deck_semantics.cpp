// SPDX-License-Identifier: LGPL-2.1-or-later
// What the cards of a deck say after an operator, checked against geometry: which nodes lie on the supported face,
// how large the loaded area is, what a linear temperature field is where a node now stands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "deck/carry_over.h"
#include "deck/load_label.h"
#include "deck/mark_deck.h"
#include "deck/rules/mesh_cards.h"
#include "deck/solver_input.h"
#include "deck_testing.h"
#include "io/inp.h"
#include "mesh/quality.h"
#include "operators/crack.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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
    const Remarks remarks = carry_deck(*marks.mesh, after, {});
    const std::vector<std::string> warnings = warnings_of(remarks, false);
    for (const std::string& line : lines) EXPECT_THAT(warnings, Contains(HasSubstr(at_line(line)))) << line;
    EXPECT_THAT(warnings, Contains(HasSubstr("REF NODE")));
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre("GONE", "2", "1.")));
    EXPECT_THAT(rows(after, "DLOAD"), IsEmpty());
    EXPECT_THAT(rows(after, "BOUNDARY"), IsEmpty());
    EXPECT_THAT(rows(after, "TEMPERATURE"), IsEmpty());
    EXPECT_THROW(warnings_of(remarks, true), Error);
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
        EXPECT_THAT(places[5], HasSubstr("deck.inp:" + std::to_string(line_of(last)) + " (carried over): "));
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
    EXPECT_THAT(warnings_, Contains(HasSubstr("4 point elements")));
    EXPECT_THAT(warnings_, Contains(HasSubstr("6 segment elements")));
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

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
