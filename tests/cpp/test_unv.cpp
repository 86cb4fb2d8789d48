// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/unv.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "format_testing.h"
#include "random_numbers.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::initializer_list<CellType> not_in_unv = {CellType::pyramid, CellType::pyramid13, CellType::wedge18,
                                                    CellType::hexahedron27};

// What FreeCAD makes of files, and of which order nodes are, is in tests/freecad/workbench/femscalpeltest/test_unv.py.
class Unv : public checks::TextReading {
protected:
    Unv() : TextReading([](const fs::path& path) { return read_unv(path); }, ".unv") {}
    std::string written(const Mesh& mesh) const {
        write_unv(mesh, path_);
        std::ifstream in(path_);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

std::string dataset(const std::string& number, const std::string& content) {
    return "    -1\n  " + number + "\n" + content + "    -1\n";
}

const std::string nodes = dataset("2411",
                                  "         2         1         1        11\n"
                                  "   0.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00\n"
                                  "         4         1         1        11\n"
                                  "   1.5000000000000000D+00   0.0000000000000000E+00   0.0000000000000000E+00\n"
                                  "         6         0         1        11\n"
                                  "   0.0                      1.25e-1                 -1.5-101\n");
const std::string triangle = dataset("2412",
                                     "         9        91         1         1         7         3\n"
                                     "         2         4         6\n");

TEST_F(Unv, WhatWriteUnvWroteComesBackExactly) {
    Mesh mesh = checks::one_of_each(not_in_unv);
    remove_group(mesh, *mesh.find_group("no nodes", GroupKind::node));
    write_unv(mesh, path_);
    const Mesh back = read_unv(path_);
    checks::expect_equal(back, mesh);
    EXPECT_THAT(back.remarks, testing::IsEmpty());
    EXPECT_EQ(back.name, path_.stem().string());
}

TEST_F(Unv, IsWrittenAsSalomeDoes) {
    Mesh mesh;
    for (Index i = 0; i < 10; ++i) mesh.add_node({static_cast<double>(i), 0.1, -1e-100}, 10 * (i + 1));
    const std::array<Index, 10> in = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    mesh.add_cell(CellType::line3, std::span(in).first(3), 5);
    mesh.add_cell(CellType::tetra10, in, 6);
    mesh.add_group("A B", GroupKind::element);
    mesh.add_group("N", GroupKind::node);
    mesh.add_group("NONE", GroupKind::node);
    mesh.add_group("SIDE", GroupKind::facet);
    mesh.add_group(std::string(41, 'x'), GroupKind::element);
    assign_groups(mesh, std::vector<GroupMembers>{{GroupKind::element, {5, 6}, {}},
                                                  {GroupKind::node, {10, 20, 30}, {}},
                                                  {GroupKind::node, {}, {}},
                                                  {GroupKind::facet, {6}, {1}},
                                                  {GroupKind::element, {}, {}}});
    mesh.unit = "mm";
    const std::string text = written(mesh);
    EXPECT_THAT(text,
                testing::StartsWith("    -1\n  2411\n        10         1         1        11\n"
                                    "   0.0000000000000000E+00   1.0000000000000001E-01 -1.0000000000000000E-100\n"));
    EXPECT_THAT(text, HasSubstr("    -1\n  2412\n"
                                "         5        22         2         1         7         3\n"
                                "         0         0         0\n        10        30        20\n"
                                "         6       118         2         1         7        10\n"
                                "        10        50        20        60        30        70        80        90\n"
                                "       100        40\n    -1\n"));
    EXPECT_THAT(text,
                HasSubstr("    -1\n  2467\n"
                          "         1         0         0         0         0         0         0         2\n"
                          "A B\n         8         5         0         0         8         6         0         0\n"
                          "         2         0         0         0         0         0         0         3\n"
                          "N\n         7        10         0         0         7        20         0         0\n"
                          "         7        30         0         0\n"
                          "         3         0         0         0         0         0         0         0\n"
                          "NONE\n"));
    EXPECT_THAT(
        unv_losses(mesh),
        ElementsAre("that the empty group 'NONE' is one of nodes", "the facet group 'SIDE'",
                    "the name '" + std::string(41, 'x') + "' for programs that read 40 bytes of it", "the unit 'mm'"));
    EXPECT_EQ(read_unv(path_).groups.back().name, std::string(41, 'x'));
}

TEST_F(Unv, WhatTheFormatHasNotIsRefused) {
    Mesh mesh = checks::grid(1, 1, 1);
    for (const char* name : {"", " A", "A ", "two\nlines", "-1"}) {
        mesh.groups.assign(1, {name, GroupKind::element, false});
        EXPECT_THAT([&] { write_unv(mesh, path_); }, ThrowsMessage<WriteError>(HasSubstr("rename the group '")));
    }
    mesh.groups.clear();
    mesh.node_ids[0] = 3'000'000'000;
    EXPECT_THAT([&] { write_unv(mesh, path_); }, ThrowsMessage<WriteError>(HasSubstr("the mesh has 3000000000")));
    for (const CellType type : not_in_unv) {
        Mesh other = checks::one_of_each({});
        for (CellBlock& block : other.blocks())
            if (block.type != type) block = {block.type, {}, {}, {}};
        EXPECT_THAT([&] { write_unv(other, path_); },
                    ThrowsMessage<WriteError>(HasSubstr("the mesh has 1 elements of type " +
                                                        std::string(traits(type).name) + ", which universal files")));
    }
    EXPECT_FALSE(fs::exists(path_));
}

TEST_F(Unv, NumbersOfFortranUnitsAndWindowsLines) {
    std::string text = dataset("151", "model\n") +
                       dataset("164",
                               "         5  mm (milli-newton)          2\n"
                               "    1.0000000000000000D+03   1.0000000000000000D+03   1.0000000000000000D+00\n"
                               "    2.7314999999999998D+02\n") +
                       nodes + triangle;
    for (const bool windows : {false, true}) {
        if (windows)
            for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 2))
                text.insert(at, 1, '\r');
        const Mesh mesh = read(text);
        EXPECT_EQ(mesh.points, (std::vector<Vec3>{{0, 0, 0}, {1.5, 0, 0}, {0, 0.125, -1.5e-101}}));
        EXPECT_EQ(mesh.unit, "mm");
        EXPECT_THAT(mesh.block(CellType::triangle).ids, ElementsAre(9));
        EXPECT_THAT(mesh.remarks, testing::IsEmpty());
    }
}

TEST_F(Unv, OlderDataSets) {
    const std::string old_nodes =
        dataset("15",
                "         1         0         0         8  0.00000E+00  0.00000E+00 -1.00000E+00\n"
                "         2         0         0         8  1.00000E+00  0.00000E+00 -1.00000E+00\n") +
        dataset("781",
                "         3         1         1        11\n"
                "  1.0000000000000000D+00  1.0000000000000000D+00  0.0000000000000000D+00\n");
    const Mesh mesh = read(old_nodes +
                           dataset("71",
                                   "         1        41         1         7         8         9         3\n"
                                   "         1         2         3\n") +
                           dataset("780",
                                   "         2        21         0         7         0         9         5         2\n"
                                   "         0         0         0         0         0\n         1         3\n"
                                   "         3        41         0         7         0         9         5         3\n"
                                   "         2         1         3\n") +
                           dataset("2417",
                                   "         4         0         0         0         0         0         0         3\n"
                                   "OLD\n         8         1         8         3         7         2\n"));
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3));
    EXPECT_EQ(mesh.points[1], Vec3(1, 0, -1));
    EXPECT_THAT(mesh.block(CellType::triangle).ids, ElementsAre(1, 3));
    EXPECT_THAT(mesh.block(CellType::line).nodes(0), ElementsAre(0, 2));
    EXPECT_THAT(checks::members(mesh, "OLD", GroupKind::element), ElementsAre(1, 3));
    EXPECT_THAT(checks::members(mesh, "OLD", GroupKind::node), ElementsAre(2));
    EXPECT_EQ(remarks(mesh), ": the elements' numbers of properties and materials are not read\n");
}

TEST_F(Unv, BeamsWithAndWithoutTheirSections) {
    const std::string with2 =
        "        21         1         1         7         2\n         0         1         1\n         2         4\n";
    const std::string without2 = "        11         1         1         7         2\n         2         4\n";
    const std::string with3 =
        "        24         1         1         7         3\n         0         1         1\n"
        "         2         6         4\n";
    const std::string without3 = "        22         1         1         7         3\n         2         6         4\n";
    const std::array<std::string, 4> kinds = {with2, without2, with3, without3};
    for (const std::string& first : kinds)
        for (const std::string& second : kinds) {
            const Mesh mesh = read(nodes + dataset("2412", "         1" + first + "         2" + second));
            Index count = 0;
            for (const CellType type : {CellType::line, CellType::line3})
                for (Index c = 0; c < mesh.block(type).size(); ++c, ++count) {
                    EXPECT_EQ(mesh.block(type).nodes(c)[0], 0);
                    EXPECT_EQ(mesh.block(type).nodes(c)[1], 1);
                    EXPECT_EQ(mesh.block(type).nodes(c).back(), type == CellType::line3 ? 2 : 1);
                }
            EXPECT_EQ(count, 2) << first << second;
        }
}

TEST_F(Unv, GroupsOfEveryKind) {
    const std::string head = "         0         0         0         0         0         0";
    const Mesh mesh =
        read(dataset("2477", "         1" + head +
                                 "         3\nBOTH\n"
                                 "         7         2         0         0         8         9         0         0\n"
                                 "         7         4         0         0\n"
                                 "         2" +
                                 head +
                                 "         0\nNONE\n\n"
                                 "         3" +
                                 head +
                                 "         1\n\n         7         6         0         0\n"
                                 "         4" +
                                 head +
                                 "         3\nBOTH\n"
                                 "         7         6         0         0         7        99         0         0\n"
                                 "         1         7         0         0\n") +
             triangle + nodes);  // in any order
    ASSERT_EQ(mesh.groups.size(), 4u);
    EXPECT_THAT(checks::members(mesh, "BOTH", GroupKind::node), ElementsAre(2, 4, 6));
    EXPECT_THAT(checks::members(mesh, "BOTH", GroupKind::element), ElementsAre(9));
    EXPECT_THAT(checks::members(mesh, "NONE", GroupKind::element), ElementsAre());
    EXPECT_THAT(checks::members(mesh, "GROUP_3", GroupKind::node), ElementsAre(6));
    const std::string told = remarks(mesh);
    EXPECT_THAT(told, HasSubstr("group 'BOTH' names 1 nodes or elements that the file does not define"));
    EXPECT_THAT(told, HasSubstr("group 'BOTH' has 1 members that are neither nodes nor elements"));
    EXPECT_THAT(told, HasSubstr("several groups are called 'BOTH'; they are one"));
    EXPECT_EQ(std::ranges::count(told, '\n'), 3);
}

std::string system(const std::string& number, int type, double x) {
    std::ostringstream out;
    out << "         " << number << "         " << type << "         8\nname\n";
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 3; ++column)
            out << "   " << (row == 3 && column == 0 ? x : row == column) << (column == 2 ? "\n" : "");
    return out.str();
}

TEST_F(Unv, CoordinateSystems) {
    const std::string head = "         1\npart\n";
    EXPECT_EQ(read(dataset("2420", head + system("1", 0, 0) + system("3", 1, 0)) + nodes + triangle).node_count(), 3);
    expect_error(
        dataset("2420", head + system("1", 0, 0.5)) + nodes + triangle,
        ":14: node 2 is given in coordinate system 1, which is turned or moved; only coordinates of the global");
    expect_error(dataset("2420", head + system("1", 1, 0)) + nodes + triangle, "which is cylindrical");
    expect_error(dataset("2420", head + system("1", 2, 0)) + nodes + triangle, "which is spherical");
    std::string other = nodes;
    other[other.find("         1") + 9] = '7';
    expect_error(other + triangle, ":3: node 2 is given in coordinate system 7, which the file does not define");
}

TEST_F(Unv, WhatIsNotReadIsTold) {
    std::string two = triangle;
    two.insert(two.rfind("    -1"),
               "        10        91         2         1         7         3\n"
               "         4         2         6\n");
    const Mesh mesh =
        read(nodes + two + dataset("2414", "1\n        -1\n") + dataset("2414", "2\n") + dataset("9999", ""));
    EXPECT_EQ(mesh.block(CellType::triangle).size(), 2);
    EXPECT_EQ(remarks(mesh),
              ": the elements' numbers of properties and materials are not read\n"
              ":18: data set 2414 is not read: results (there are 2 of them)\n"
              ":27: data set 9999 is not read\n");
}

TEST_F(Unv, ErrorsNameTheLine) {
    expect_error("", ": there are no nodes in this file");
    expect_error("hello\n", ":1: this is no universal file, which begins with a line of -1");
    expect_error(nodes + "hello\n", ":10: expected a line of -1, which opens a data set, not 'hello'");
    expect_error("    -1\nhello\n", ":2: expected the number of a data set, not 'hello'");
    expect_error("    -1\n  2411\n", ":2: data set 2411 does not end; the file is truncated or damaged");
    expect_error(triangle, ": there are no nodes in this file");
    expect_error(dataset("2411", "         1         1\n"),
                 ":4: data set 2411 ends where the displacement system of a node should follow");
    expect_error(dataset("2411", "         x         1\n"),
                 ":3: the number of a node should be a whole number, not 'x'");
    expect_error(dataset("2411", " 1 1 1 1\n0,5 0 0\n"), ":4: a coordinate should be a finite number, not '0,5'");
    expect_error(dataset("2411", " 1 1 1 1\nnan 0 0\n"), ":4: a coordinate should be a finite number, not 'nan'");
    expect_error(dataset("2411", " 0 1 1 1\n0 0 0\n"), ":3: a node has the number 0");
    expect_error(nodes + nodes, ":12: the number of this node is used twice");
    expect_error(nodes + triangle + triangle, ":17: the number of this element is used twice");
    expect_error(nodes + dataset("2412", " 1 91 1 1 7 3\n 2 4 7\n"),
                 ":13: element 1 names node 7, which the file does not define");
    expect_error(nodes + dataset("2412", " 1 121 1 1 7 2\n 2 4\n"),
                 ":12: element 1 has the descriptor 121 (rigid bar) and 2 nodes, which FemScalpel cannot hold");
    expect_error(nodes + dataset("2412", " 1 91 1 1 7 4\n 2 4 6 2\n"),
                 ":12: element 1 has the descriptor 91 and 4 nodes");
    expect_error(nodes + dataset("2467", " 1 0 0 0 0 0 0 999999\nA\n"),
                 "is more than the rest of the data set can hold");
    expect_error(nodes + dataset("2467", " 1 0 0 0 0 0 0 2\nA\n 7 2 0 0\n"),
                 "data set 2467 ends where the kind of a group's member should follow");
}

TEST_F(Unv, DamagedFilesGiveAMeshOrAReadError) {
    const std::string whole = written(checks::one_of_each(not_in_unv));
    const std::string other = dataset("164", "         1  SI\n") +
                              dataset("2420", "         1\np\n" + system("1", 0, 0)) + nodes + triangle +
                              dataset("2467", " 1 0 0 0 0 0 0 2\nA\n 7 2 0 0 8 9 0 0\n");
    checks::Random random(6);
    for (const std::string& file : {whole, other}) read_damaged(file, 3000, "0123456789-. \n\"eD", random);
    EXPECT_GT(read_well_, 300);
    EXPECT_GT(refused_, 300);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
