// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/bdf.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "format_testing.h"
#include "io/inp.h"
#include "random_numbers.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::initializer_list<CellType> not_in_bdf = {CellType::vertex, CellType::triangle7, CellType::wedge18,
                                                    CellType::hexahedron27};

// What pyNastran makes of files, and of which order nodes are, is in tests/python/test_bdf.py.
class Bdf : public checks::TextReading {
protected:
    Bdf() : TextReading([](const fs::path& path) { return read_bdf(path); }, ".bdf") {}
    std::string written(const Mesh& mesh) const {
        write_bdf(mesh, path_);
        std::ifstream in(path_);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    std::vector<Index> members(const Mesh& mesh, const char* name, GroupKind kind) const {
        const auto group = mesh.find_group(name, kind);
        EXPECT_TRUE(group) << name;
        return group ? group_members(mesh, *group).ids : std::vector<Index>();
    }
};

const std::string triangle_nodes =
    "GRID,2,,0.,0.,0.\n"
    "GRID,4,,1.5,0.,0.\n"
    "GRID,6,,0.,1.25-1,-1.5D-2\n";

TEST_F(Bdf, BarsAlongOthersStayBeamsInADeck) {
    const Mesh mesh = read(triangle_nodes +
                           "CTRIA3,1,1,2,4,6\n"
                           "CBAR,2,2,2,4,0.,0.,1.\n"
                           "CROD,3,2,4,6\n");
    const fs::path path = path_.string() + ".inp";
    write_inp(mesh, path);
    const Mesh back = read_inp(path);
    fs::remove(path);
    EXPECT_THAT(back.block(CellType::line).ids, ElementsAre(2, 3));
    EXPECT_THAT(inp_losses(mesh), ElementsAre());
}

TEST_F(Bdf, WhatWriteBdfWroteComesBackExactly) {
    Mesh mesh = checks::one_of_each(not_in_bdf);
    // Coordinates that 16 characters hold.
    for (Vec3& p : mesh.points)
        for (int a = 0; a < 3; ++a) {
            char digits[32];
            std::snprintf(digits, sizeof digits, "%.9g", p[a]);
            p[a] = std::strtod(digits, nullptr);
        }
    const std::string text = written(mesh);
    const Mesh back = read(text);
    checks::expect_equal(back, mesh);
    EXPECT_TRUE(bdf_losses(mesh).empty()) << bdf_losses(mesh).front();
    EXPECT_EQ(written(back), text);
}

TEST_F(Bdf, NumbersAreTheNearestThatAFieldHolds) {
    checks::Random random(7);
    Mesh mesh;
    for (int n = 0; n < 2000; ++n) {
        const auto number = [&] {
            return (static_cast<double>(random.bits() % 2000001) / 1e6 - 1 + 1.0 / 3e9) *
                   std::pow(10, static_cast<double>(random.bits() % 40) - 20);
        };
        mesh.add_node(Vec3(number(), number(), std::ldexp(number(), 3)), n + 1);
    }
    mesh.points[0] = Vec3(-0.0, 1e300, -1e-300);
    mesh.points[1] = Vec3(123456789012345.0, 0.1, -100);
    const std::vector<std::string> losses = bdf_losses(mesh);
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_THAT(losses[0], HasSubstr("the last digits of the coordinates of "));
    const Mesh back = read(written(mesh));
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        for (int a = 0; a < 3; ++a)
            EXPECT_NEAR(back.points[n][a], mesh.points[n][a], 1e-10 * std::abs(mesh.points[n][a])) << n;
    EXPECT_EQ(back.points[0], mesh.points[0]);
    EXPECT_EQ(back.points[1], mesh.points[1]);
}

TEST_F(Bdf, TheLargestNumbersAreNotRoundedToInfinity) {
    const double largest = std::numeric_limits<double>::max();
    Mesh mesh;
    mesh.add_node(Vec3(largest, -largest, std::nextafter(-largest, 0)), 1);
    const Mesh back = read(written(mesh));
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(back.points[0][a] / mesh.points[0][a], 1, 1e-8);
    EXPECT_THAT(bdf_losses(mesh), ElementsAre(HasSubstr("the last digits of the coordinates of 1 node ")));
}

TEST_F(Bdf, FieldsAreSmallLargeOrFree) {
    const Mesh mesh = read(
        "$ a comment\n"
        "GRID           2       0      0.      0.      0.       0\n"
        "GRID*                  4               0             1.5              0.*A\n"
        "*A                    0.\n"
        "grid\t6\t\t0.\t1.25-1\t-1.5D-2 $ and another\n"
        "CTRIA3, 9, 7, 2, 4, 6\n");
    EXPECT_THAT(mesh.node_ids, ElementsAre(2, 4, 6));
    EXPECT_EQ(mesh.points[1], Vec3(1.5, 0, 0));
    EXPECT_EQ(mesh.points[2], Vec3(0, 0.125, -0.015));
    EXPECT_THAT(mesh.block(CellType::triangle).connectivity, ElementsAre(0, 1, 2));
    EXPECT_THAT(members(mesh, "PID_7", GroupKind::element), ElementsAre(9));
    EXPECT_THAT(mesh.remarks, ElementsAre());
}

TEST_F(Bdf, CardsGoOnInFurtherLines) {
    const Mesh mesh = read(
        "GRID,1\nGRID,2,,1.\nGRID,3,,0.,1.\nGRID,4,,0.,0.,1.\n"
        "GRID,5,,.5\nGRID,6,,.5,.5\nGRID,7,,0.,.5\nGRID,8,,0.,0.,.5\nGRID,9,,.5,0.,.5\nGRID,10,,0.,.5,.5\n"
        "CTETRA         1       1       1       2       3       4       5       6+AB\n"
        "+AB            7       8       9      10\n"
        "CTETRA,2,1,1,2,3,4\n"
        "CTETRA         3       1       1       2       3       4\n");
    EXPECT_THAT(mesh.block(CellType::tetra10).connectivity, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
    EXPECT_THAT(mesh.block(CellType::tetra).ids, ElementsAre(2, 3));
    expect_error("+AB            7       8\n" + triangle_nodes, ":1: this line goes on with a card, but there is none");
    expect_error(
        "CTETRA         1       1       1       2       3       4       5       6+AB\n"
        "+CD            7       8       9      10\n",
        ":2: this line goes on with the card of mark 'AB', but its own is 'CD'");
}

TEST_F(Bdf, NodesAreInTheirCoordinateSystems) {
    const Mesh mesh = read(
        "GRDSET,,3\n"
        "GRID,1,0,1.,2.,3.\n"
        "GRID,2,,1.,0.,0.\n"      // of GRDSET
        "GRID,3,5,2.,90.,1.\n"    // cylindrical, in system 3
        "GRID,4,6,2.,90.,-90.\n"  // spherical
        "GRID,5,7,1.,0.,0.\n"     // by nodes
        "GRID,11,0,1.,0.,0.\nGRID,12,0,1.,0.,2.\nGRID,13,0,1.,3.,0.\n"
        "CORD2C,5,3,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\n"
        "CORD2R,3,0,10.,0.,0.,10.,0.,1.,\n,10.,1.,0.\n"  // x is the basic y, y the basic -x
        "CORD2S,6,0,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\n"
        "CORD1R,7,11,12,13\n");
    const auto expect_at = [&](std::size_t n, const Vec3& at) {
        EXPECT_LT((mesh.points[n] - at).norm(), 1e-14) << n << ": " << mesh.points[n].transpose();
    };
    EXPECT_EQ(mesh.points[0], Vec3(1, 2, 3));
    expect_at(1, {10, 1, 0});
    expect_at(2, {8, 0, 1});
    expect_at(3, {0, -2, 0});
    expect_at(4, {1, 1, 0});
    expect_error("GRID,1,9,0.,0.,0.\n", ":1: coordinate system 9 is not defined in this file");
    expect_error("GRID,1,3,0.,0.,0.\nCORD2R,3,4,0.,0.,0.,0.,0.,1.,\n,1.\nCORD2R,4,3,0.,0.,0.,0.,0.,1.,\n,1.\n",
                 ":2: coordinate system 3 is given in itself, by way of others");
    expect_error("GRID,1,3,0.,0.,0.\nCORD2R,3,,0.,0.,0.,0.,0.,1.,\n,0.,0.,2.\n",
                 ":2: the three points of coordinate system 3 lie on a line");
}

const std::string four_elements =
    "GRID,1\nGRID,2,,1.\nGRID,3,,1.,1.\nGRID,4,,0.,1.\n"
    "CTRIA3,11,3,1,2,3\nCTRIA3,12,3,1,3,4\nCBAR,13,8,1,2,0.,0.,1.\nCONROD,14,2,2,3,1.5\n";

TEST_F(Bdf, PropertiesSetsAndSupportsAreGroups) {
    const Mesh mesh = read(
        "SOL 101\n"
        "CEND\n"
        "DISP = 2\n"
        "SUBCASE 1\n"
        "stress(PLOT) = 3\n"
        "SET 2 = 1 THRU 4 EXCEPT 2,\n"
        "        900\n"
        "SET 3 = 11, 13\n"
        "SET 4 = 3, 12, 901\n"
        "SET 5 = ALL\n"
        "BEGIN BULK\n"
        "$HMNAME PROP                   3\"the web\" 4\n"
        "$ Femap Property 8 : flange\n" +
        four_elements +
        "SPC1,1,123,1,THRU,3\nSPC1,1,3456,4\nSPC,2,1,3,0.,2,3,0.\nSPC1,1,123,4\n"
        "ENDDATA\nnothing is read here\n");
    EXPECT_THAT(members(mesh, "the web", GroupKind::element), ElementsAre(11, 12));
    EXPECT_THAT(members(mesh, "flange", GroupKind::element), ElementsAre(13));
    EXPECT_THAT(members(mesh, "CONROD", GroupKind::element), ElementsAre(14));
    EXPECT_THAT(members(mesh, "SET_2", GroupKind::node), ElementsAre(1, 3, 4));
    EXPECT_FALSE(mesh.find_group("SET_2", GroupKind::element));
    EXPECT_THAT(members(mesh, "SET_3", GroupKind::element), testing::UnorderedElementsAre(11, 13));
    EXPECT_FALSE(mesh.find_group("SET_3", GroupKind::node));
    EXPECT_THAT(members(mesh, "SET_4", GroupKind::node), ElementsAre(3));
    EXPECT_THAT(members(mesh, "SET_4", GroupKind::element), ElementsAre(12));
    EXPECT_THAT(members(mesh, "SPC_1_123", GroupKind::node), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(members(mesh, "SPC_1_3456", GroupKind::node), ElementsAre(4));
    EXPECT_THAT(members(mesh, "SPC_2_3", GroupKind::node), ElementsAre(1, 2));
    EXPECT_THAT(
        remarks(mesh),
        AllOf(HasSubstr(":6: group 'SET_2' names 1 nodes or elements that the file does not define"),
              HasSubstr(":9: group 'SET_4' names 1 nodes or elements that the file does not define\n"),
              Not(HasSubstr("'SET_4' names 2")),
              HasSubstr(":9: nothing says whether set 4 is of nodes or of elements; there is a group of each"),
              HasSubstr(":10: set 5 is not read: it lists no numbers"), HasSubstr("there are 3 other statements"),
              HasSubstr("(orientation, offsets, thickness) is not "
                        "read: CBAR, CONROD"),
              HasSubstr("supports (SPC, SPC1) are read as groups of their nodes alone")));
}

TEST_F(Bdf, WhatIsNotReadIsNamed) {
    const Mesh mesh = read(four_elements +
                           "GRID,7,,3.,0.,0.,9,123\n"
                           "CELAS2,21,1.,1,1,2,1\nCONM2,22,1,,3.5\nCONM2,23,1,,3.5\nRBE2,24,1,123,2,3\nRBE3,25,,1\n"
                           "PSHELL,3,1,.5\nMAT1,1,2.1+5,,.3\n");
    EXPECT_THAT(remarks(mesh),
                AllOf(HasSubstr(":10: CELAS2 is not read: springs\n"),
                      HasSubstr(":11: CONM2 is not read: masses (there are 2 of them)"),
                      HasSubstr("RBE2 is not read: rigid elements"), HasSubstr("RBE3 is not read: rigid elements"),
                      HasSubstr("PSHELL is not read\n"), HasSubstr("MAT1 is not read\n"),
                      HasSubstr("the displacement systems (CD) of 1 nodes"), HasSubstr("the permanent supports (PS)")));
}

TEST_F(Bdf, ErrorsNameLineAndEntity) {
    expect_error("", ": this is no Nastran deck");
    expect_error("SOL 101\nCEND\nBEGIN BULK\nENDDATA\n", ": there are no nodes (GRID) in this file");
    expect_error(triangle_nodes + "GRID,4,,1.\n", ":4: the number of this node is used twice");
    expect_error(triangle_nodes + "CTRIA3,9,1,2,4,5\n", ":4: element 9 names node 5, which the file does not define");
    expect_error(triangle_nodes + "CTRIA3,9,1,2,4\n", ":4: CTRIA3 lacks the number of a node (field 6)");
    expect_error(triangle_nodes + "CTRIA3,9,1,2,4,6\nCROD,9,1,2,4\n", ":5: the number of this element is used twice");
    expect_error("GRID,1,,0.,1.5x,2.\n", ":1: GRID: a coordinate (field 5) is '1.5x', not a number");
    expect_error("GRID,1.,,0.\n", ":1: GRID: the number of the node (field 2) is '1.', not a whole number");
    expect_error(triangle_nodes + "INCLUDE 'mesh.bdf'\n", ":4: INCLUDE is not followed");
    expect_error(triangle_nodes + "CTRIA6,9,1,2,4,6,2\n",
                 ":4: CTRIA6 9 has 1 of its 3 mid-side nodes; FemScalpel holds elements with all or none");
    expect_error(triangle_nodes + "CTRIAX6,9,1,2,4,6\n", ":4: elements CTRIAX6 are none that FemScalpel can hold");
    expect_error("    -1\n  2411\n", ":1: ");
}

TEST_F(Bdf, WritingRefusesWhatNastranHasNot) {
    const auto expect_refused = [&](const Mesh& mesh, const char* message) {
        EXPECT_THAT([&] { write_bdf(mesh, path_); }, testing::ThrowsMessage<WriteError>(HasSubstr(message)));
        EXPECT_FALSE(fs::exists(path_));
    };
    expect_refused(Mesh(), ": the mesh has no nodes");
    Mesh mesh = checks::grid(1, 1, 1);
    mesh.node_ids[2] = 100000000;
    expect_refused(mesh, "Nastran has numbers up to 99999999, the mesh has 100000000");
    mesh.node_ids[2] = 1000;
    mesh.add_group("a \"b\"", GroupKind::node);
    expect_refused(mesh, "rename the group 'a \"b\"'");
    expect_refused(checks::one_of_each({}), "elements of type vertex, which Nastran does not have");
}

TEST_F(Bdf, DamagedFilesAreRefusedOrRead) {
    checks::Random random(11);
    Mesh mesh = checks::one_of_each(not_in_bdf);
    read_damaged(written(mesh), 1500, "0123456789+-.,*$ \nTHRUSEC", random);
    read_damaged(four_elements + "CORD2R,3,0,10.,0.,0.,10.,0.,1.,\n,10.,1.,0.\nGRID,8,3,1.\nSPC1,1,123,1,THRU,3\n",
                 1500, "0123456789+-.,*$ \nTHRU", random);
    EXPECT_GT(refused_, 500);
    EXPECT_GT(read_well_, 200);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
