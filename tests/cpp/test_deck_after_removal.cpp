// SPDX-License-Identifier: LGPL-2.1-or-later
// What the cards of a deck say after a hole or a slot took away some of what they name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deck_testing.h"
#include "error.h"
#include "mesh/quality.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "tools/cylinder.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// The slot takes the middle of the block: what is between x = 1.55 and 2.45, and with it the nodes at x = 2.
constexpr double low = 1.55, high = 2.45;

class DeckAfterRemoval : public DeckSemantics {
protected:
    Result slot(const Mesh& mesh, bool strict = false, double width = high - low) {
        CutOptions options;
        options.name = "SLOT";
        options.strict = strict;
        return cut(mesh, Plane(Vec3(2, 1, 1), Vec3(1, 0, 0)), width, options);
    }
    Mesh slotted(const Mesh& mesh) { return written(slot(mesh)); }

    std::string text(Index number) const { return std::to_string(number); }
};

TEST_F(DeckAfterRemoval, LinesThatNameRemovedNodesGoAndAreReported) {
    const Index gone = node_at(2, 1, 1), stays = node_at(4, 0, 0);
    const auto line = [&](Index node, const char* rest) { return text(node) + rest; };
    const std::string bad[] = {line(gone, ", 1, 3"),
                               line(gone, ", 300."),
                               line(gone, ", 1, 7."),
                               line(gone, ", 20."),
                               "SUBMODELLED, " + text(gone),
                               line(gone, ", 1, 1., 1, 1, -1."),
                               "PLANE, " + text(node_at(2, 0, 0)) + ", " + text(node_at(0, 0, 0)) + ", " +
                                   text(node_at(4, 0, 0)) + ", " + text(node_at(0, 1, 0))};
    const std::string good[] = {line(stays, ", 1, 3"), line(stays, ", 400."), line(stays, ", 1, 8."),
                                line(stays, ", 30."), line(stays, ", 1, 1., 1, 1, -1.")};
    const Mesh mesh = block_with("*BOUNDARY\n" + bad[0] + "\n" + good[0] + "\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\n" +
                                 bad[3] + "\n" + good[3] + "\n*EQUATION\n2\n" + bad[5] + "\n2\n" + good[4] +
                                 "\n*MPC\n" + bad[6] + "\n*STEP\n*STATIC\n*CLOAD\n" + bad[2] + "\n" + good[2] +
                                 "\n*TEMPERATURE\n" + bad[1] + "\n" + good[1] + "\n*END STEP\n");
    const Mesh after = slotted(mesh);
    for (const int k : {0, 1, 2, 3, 5, 6})
        EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr(at_line(bad[k])), HasSubstr("was removed")))) << bad[k];
    EXPECT_THAT(rows(after, "BOUNDARY"), ElementsAre(ElementsAre(text(stays), "1", "3")));
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre(text(stays), "1", "8.")));
    EXPECT_THAT(rows(after, "TEMPERATURE"), ElementsAre(ElementsAre(text(stays), "400.")));
    EXPECT_THAT(rows(after, "INITIALCONDITIONS"), ElementsAre(ElementsAre(text(stays), "30.")));
    // The whole equation goes, its number of terms too; the other stays.
    EXPECT_THAT(rows(after, "EQUATION"),
                ElementsAre(ElementsAre("2"), ElementsAre(text(stays), "1", "1.", "1", "1", "-1.")));
    // A list of nodes in a plane is one node shorter.
    EXPECT_THAT(rows(after, "MPC"), ElementsAre(ElementsAre("PLANE", text(node_at(0, 0, 0)), text(node_at(4, 0, 0)),
                                                            text(node_at(0, 1, 0)))));
    try {
        slot(mesh, true);
        FAIL() << "strict accepts a deck that cannot follow";
    } catch (const Error& error) {
        for (const int k : {0, 1, 2, 3, 5, 6}) EXPECT_THAT(error.what(), HasSubstr(at_line(bad[k])));
    }
}

TEST_F(DeckAfterRemoval, LinesThatNameRemovedElementsGoAndAreReported) {
    // All cubes between x = 1 and 3 go whole.
    constexpr double width = 2.2;
    const auto element = [](int i, int o) { return static_cast<Index>(6 * i + o + 1); };
    const Index gone = element(1, 2), stays = element(3, 2);
    std::string inner = "*ELSET, ELSET=INNER\n", mixed = "*ELSET, ELSET=MIXED\n";
    for (int o = 0; o < 6; ++o) {
        inner += text(element(1, o)) + ", " + text(element(2, o)) + "\n";
        mixed += text(element(2, o)) + ", " + text(element(3, o)) + "\n";
    }
    const std::string stress = ", 1, 1., 2., 3., 0., 0., 0.",
                      bad[] = {text(gone) + stress, text(gone) + ", P1, 3.", text(gone) + ", BX, 4.", text(gone),
                               "INNER, GRAV, 9.81, 0., 0., -1."};
    const std::string good[] = {text(stays) + stress, text(stays) + ", P1, 3.", text(stays) + ", BX, 4."};
    const std::string section = "*SOLID SECTION, ELSET=INNER, MATERIAL=M";
    const Mesh mesh = block_with(
        inner + mixed + "*MATERIAL, NAME=M\n*ELASTIC\n1., 0.\n" + section + "\n*INITIAL CONDITIONS, TYPE=STRESS\n" +
        bad[0] + "\n" + good[0] + "\n*STEP\n*STATIC\n*DLOAD\n" + bad[1] + "\n" + good[1] + "\n" + bad[2] + "\n" +
        good[2] + "\n" + bad[4] + "\nMIXED, GRAV, 9.81, 0., 0., -1.\n*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n" + bad[3] +
        "\n*END STEP\n");
    const Mesh after = written(slot(mesh, false, width));
    for (const std::string& line : {bad[0], bad[1], bad[2], bad[3], bad[4], section})
        EXPECT_THAT(warnings_, Contains(HasSubstr(at_line(line)))) << line;
    EXPECT_THAT(element_set(after, "INNER"), IsEmpty());
    // The set keeps what is left of its elements: the cube from x = 3 to 4, cut at 3.1.
    double volume = 0;
    const NumberIndex numbers(after);
    for (const Index e : element_set(after, "MIXED"))
        volume += cell_measure(after, CellType::tetra, numbers.cell(e)->cell);
    EXPECT_NEAR(volume, 0.9, 1e-9);
    for (const char* keyword : {"DLOAD", "INITIALCONDITIONS", "MODELCHANGE"})
        for (const Row& r : rows(after, keyword))
            if (is_number(r[0])) {
                EXPECT_TRUE(numbers.cell(std::stoll(r[0]))) << keyword << " names element " << r[0];
            }
    EXPECT_THAT(rows(after, "MODELCHANGE"), IsEmpty());
    EXPECT_THROW(slot(mesh, true, width), Error);
}

TEST_F(DeckAfterRemoval, SetsAndSurfacesLoseWhatIsRemoved) {
    const auto on_top = [](const Vec3& p) { return std::abs(p.z() - nz) < 1e-12; };
    std::string top = "*SURFACE, NAME=TOP, TYPE=ELEMENT\n", bottom = "*NSET, NSET=BOTTOM\n",
                middle = "*NSET, NSET=MIDDLE\n";
    for (const auto& [e, f] : top_faces()) top += text(e) + ", S" + text(f) + "\n";
    for (int j = 0; j <= ny; ++j) {
        for (int i = 0; i <= nx; ++i) bottom += text(node_at(i, j, 0)) + ",\n";
        for (int k = 0; k <= nz; ++k) middle += text(node_at(2, j, k)) + ",\n";
    }
    const std::string naming = "MIDDLE, 1, 1", printing = "*NODE PRINT, NSET=MIDDLE", tie = "MIDDLE_S, TOP";
    const Mesh mesh = block_with(top + bottom + middle + "*SURFACE, NAME=MIDDLE_S, TYPE=NODE\nMIDDLE\n*TIE, NAME=T1\n" +
                                 tie + "\n*TRANSFORM, NSET=BOTTOM\n1, 0, 0, 0, 1, 0\n*BOUNDARY\nBOTTOM, 3, 3\n" +
                                 naming + "\n*STEP\n*STATIC\n*DSLOAD\nTOP, P, 2.\n" + printing +
                                 "\nU\n*NODE PRINT, NSET=BOTTOM\nU\n*END STEP\n");
    const Mesh after = slotted(mesh);
    EXPECT_NEAR(surface_area(after, "TOP", on_top), (nx - (high - low)) * ny, 1e-9);
    const auto found = node_set(after, "BOTTOM");
    EXPECT_EQ(std::set<Index>(found.begin(), found.end()),
              nodes_where(after, [](const Vec3& p) { return p.z() == 0; }));
    EXPECT_THAT(node_set(after, "MIDDLE"), IsEmpty());
    EXPECT_TRUE(after.find_group("MIDDLE", GroupKind::node)) << "an emptied set stays defined";
    // Who names the emptied sets is told, by line; who names what is left, not.
    for (const std::string& line : {naming, printing, tie})
        EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr(at_line(line)), HasSubstr("lost all its members")))) << line;
    EXPECT_THAT(warnings_, Not(Contains(AllOf(HasSubstr("deck.inp"), Not(HasSubstr("MIDDLE"))))));
    EXPECT_THAT(warnings_, Contains(HasSubstr("group 'MIDDLE' loses all its 9 members")));
    for (const char* keyword : {"TIE", "TRANSFORM", "BOUNDARY", "DSLOAD", "NODEPRINT"})
        EXPECT_EQ(text_of(after, keyword), text_of(mesh, keyword)) << keyword;
    EXPECT_THROW(slot(mesh, true), Error);
}

TEST_F(DeckAfterRemoval, NothingRemovedIsNamedNothingIsSaid) {
    const Mesh mesh = block_with("*BOUNDARY\n" + text(node_at(0, 0, 0)) + ", 1, 3\n*STEP\n*STATIC\n*CLOAD\n" +
                                 text(node_at(4, 0, 0)) + ", 1, 1.\n*END STEP\n");
    const Mesh after = written(slot(mesh, true));  // strict
    EXPECT_THAT(warnings_, Not(Contains(HasSubstr("deck.inp"))));
    for (const char* keyword : {"BOUNDARY", "CLOAD"})
        EXPECT_EQ(text_of(after, keyword), text_of(mesh, keyword)) << keyword;
}

TEST_F(DeckAfterRemoval, LoadedAreaIsThatOfWhatIsLeft) {
    // By number and by set; a body force on every element.
    std::string loads = "*DLOAD\n";
    for (const auto& [e, f] : top_faces()) loads += text(e) + ", P" + text(f) + ", 2.\n";
    const Mesh mesh = block_with("*STEP\n*STATIC\n" + loads + "EALL, GRAV, 9.81, 0., 0., -1.\n*END STEP\n");
    const Mesh after = slotted(mesh);
    double area = 0;
    const NumberIndex numbers(after);
    for (const Row& r : rows(after, "DLOAD")) {
        if (!is_number(r[0])) continue;
        const CellRef cell = *numbers.cell(std::stoll(r[0]));
        const auto n = after.block(cell.type).nodes(cell.cell);
        std::array<Vec3, 3> p;
        for (int k = 0; k < 3; ++k) {
            p[k] = after.points[n[solver_faces[r[1][1] - '1'][k]]];
            EXPECT_NEAR(p[k].z(), nz, 1e-12);
        }
        area += (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2;
    }
    EXPECT_NEAR(area, (nx - (high - low)) * ny, 1e-9);
    EXPECT_THAT(warnings_, Contains(HasSubstr("was removed, and with it its P")));
}

TEST_F(DeckAfterRemoval, ElementsOutsideTheMeshKeepTheirNodesOrItIsAnError) {
    const std::string user =
        "*USER ELEMENT, TYPE=US3, NODES=2, INTEGRATION POINTS=1, MAXDOF=3\n*ELEMENT, TYPE=US3, ELSET=U\n500, ";
    const Mesh far = block_with(user + text(node_at(4, 1, 2)) + ", 1\n");
    slotted(far);
    const Mesh held = block_with(user + text(node_at(2, 1, 2)) + ", 1\n");
    EXPECT_THAT([&] { slot(held); }, testing::ThrowsMessage<Error>(AllOf(
                                         HasSubstr("deck.inp:"),
                                         HasSubstr("element 500 of type US3 needs node " + text(node_at(2, 1, 2))))));
}

TEST_F(DeckAfterRemoval, HolesDoAsSlots) {
    // Round, through the middle: the node at its axis goes, those at a distance of 1 stay.
    const std::string bad = text(node_at(2, 1, 2)) + ", 3, 5.", good = text(node_at(2, 0, 2)) + ", 3, 5.";
    const Mesh mesh = block_with("*STEP\n*STATIC\n*CLOAD\n" + bad + "\n" + good + "\n*END STEP\n");
    const Cylinder tool(Vec3(2, 1, 0), Vec3(0, 0, 1), 0.7);
    const Tool* tools[] = {&tool};
    DrillOptions options;
    options.name = "HOLE";
    const Mesh after = written(drill(mesh, tools, options));
    EXPECT_THAT(rows(after, "CLOAD"), ElementsAre(ElementsAre(text(node_at(2, 0, 2)), "3", "5.")));
    EXPECT_THAT(warnings_, Contains(AllOf(HasSubstr(at_line(bad)), HasSubstr("was removed, and with it the load"))));
    EXPECT_EQ(place(after, node_at(2, 0, 2)), Vec3(2, 0, 2)) << "a loaded node does not move";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
