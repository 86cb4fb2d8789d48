// SPDX-License-Identifier: LGPL-2.1-or-later
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "format_testing.h"
#include "io/msh.h"
#include "random_numbers.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using checks::Bytes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Files that Gmsh and meshio wrote are in tests/python/test_msh_reader.py.
class MshReading : public checks::TextReading {
protected:
    MshReading() : TextReading([](const fs::path& path) { return read_msh(path); }, ".msh") {}
};

const std::string head22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string head41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string five_nodes = "$Nodes\n5\n2 0 0 0\n4 1 0 0\n6 0 1 0\n8 0 0 1\n10 1 1 1\n$EndNodes\n";

TEST_F(MshReading, WhatWriteMshWroteComesBackExactly) {
    for (const bool points : {true, false}) {
        Mesh mesh = checks::one_of_each({CellType::triangle7});
        if (!points) mesh = checks::one_of_each({CellType::triangle7, CellType::vertex});
        write_msh(mesh, path_);
        const Mesh back = read_msh(path_);
        checks::expect_equal(back, mesh);
        EXPECT_EQ(back.name, path_.stem().string());
        EXPECT_THAT(back.remarks, testing::IsEmpty());
    }
    Mesh nodes;
    nodes.add_node({1, 2, 3}, 7);
    nodes.add_group("EMPTY", GroupKind::element);
    nodes.add_group("N", GroupKind::node);
    set_group_members(nodes, 1, {GroupKind::node, {7}, {}});
    write_msh(nodes, path_);
    checks::expect_equal(read_msh(path_), nodes);
}

TEST_F(MshReading, RepeatedElementsOfVersion2AreOne) {
    const Mesh mesh =
        read(head22 + "$PhysicalNames\n3\n2 1 \"A\"\n2 2 \"B\"\n0 4 \"P\"\n$EndPhysicalNames\n" + five_nodes +
             "$Elements\n11\n"
             "1 15 2 4 1 2\n2 15 2 9 1 2\n"          // a point in two groups
             "3 2 2 1 5 2 4 6\n4 2 2 2 5 2 4 6\n"    // one triangle in two groups
             "5 2 2 1 5 2 4 8\n6 2 2 1 5 2 4 8\n"    // two triangles in the same group
             "7 2 2 1 5 2 6 8\n8 2 2 2 6 2 6 8\n"    // two, of two surfaces
             "9 2 2 1 5 4 6 8\n10 2 2 -2 5 4 8 6\n"  // one, seen from both sides
             "13 2 1 0 2 4 10\n$EndElements\n");     // one in no group
    const CellBlock& triangles = mesh.block(CellType::triangle);
    EXPECT_THAT(triangles.ids, ElementsAre(3, 5, 6, 7, 8, 9, 13));
    EXPECT_THAT(triangles.nodes(5), ElementsAre(1, 2, 3));
    EXPECT_EQ(mesh.block(CellType::vertex).size(), 0);
    EXPECT_THAT(checks::members(mesh, "A", GroupKind::element), ElementsAre(3, 5, 6, 7, 9));
    EXPECT_THAT(checks::members(mesh, "B", GroupKind::element), ElementsAre(3, 8, 9));
    EXPECT_THAT(checks::members(mesh, "P", GroupKind::node), ElementsAre(2));
    EXPECT_THAT(checks::members(mesh, "PhysicalPoint9", GroupKind::node), ElementsAre(2));
    EXPECT_THAT(remarks(mesh), HasSubstr(": 2 elements repeat the one before them in another physical group"));
    EXPECT_THAT(remarks(mesh), HasSubstr(": 1 elements are in physical groups of both signs"));
}

TEST_F(MshReading, NegativeGroupsTurnEdgesAndFacesRound) {
    const Mesh two = read(head22 + five_nodes +
                          "$Elements\n3\n1 1 2 -3 1 2 4\n2 3 2 -3 1 2 4 6 8\n3 4 2 -3 1 2 4 6 8\n$EndElements\n");
    EXPECT_THAT(two.block(CellType::line).nodes(0), ElementsAre(1, 0));
    EXPECT_THAT(two.block(CellType::quad).nodes(0), ElementsAre(0, 3, 2, 1));
    EXPECT_THAT(two.block(CellType::tetra).nodes(0), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(checks::members(two, "PhysicalLine3", GroupKind::element), ElementsAre(1));
    EXPECT_THAT(checks::members(two, "PhysicalSurface3", GroupKind::element), ElementsAre(2));
    EXPECT_THAT(checks::members(two, "PhysicalVolume3", GroupKind::element), ElementsAre(3));
    std::string nodes = "$Nodes\n1 8 1 8\n2 1 0 8\n1\n2\n3\n4\n5\n6\n7\n8\n";
    for (int i = 0; i < 8; ++i) nodes += std::to_string(i) + " 0 0\n";
    const Mesh four = read(head41 +
                           "$Entities\n0 0 3 0\n1 0 0 0 1 1 1 1 -7 0\n2 0 0 0 1 1 1 2 -7 8 0\n3 0 0 0 1 1 1 0 0\n"
                           "$EndEntities\n" +
                           nodes +
                           "$EndNodes\n$Elements\n3 3 1 3\n2 1 16 1\n1 1 2 3 4 5 6 7 8\n2 2 2 1\n2 1 2 3\n2 3 9 1\n"
                           "3 1 2 3 4 5 6\n$EndElements\n");
    EXPECT_THAT(four.block(CellType::quad8).nodes(0), ElementsAre(0, 3, 2, 1, 7, 6, 5, 4));
    EXPECT_THAT(four.block(CellType::triangle).nodes(0), ElementsAre(0, 1, 2));
    EXPECT_THAT(four.block(CellType::triangle6).nodes(0), ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(checks::members(four, "PhysicalSurface7", GroupKind::element), ElementsAre(2, 1));
    EXPECT_THAT(remarks(four), HasSubstr(": 1 elements are in physical groups of both signs"));
}

TEST_F(MshReading, Version4_0HasSixNumbersPerPointAndTagsBeforeDimensions) {
    const Mesh mesh = read(
        "$MeshFormat\n4 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 3 \"S\"\n$EndPhysicalNames\n"
        "$Entities\n2 0 1 0\n1 0 0 0 0 0 0 1 5\n2 1 0 0 1 0 0 1 6\n9 0 0 0 1 1 0 1 3 2 1 -2\n$EndEntities\n"
        "$Nodes\n3 4\n1 0 0 1\n11 0 0 0\n2 0 0 1\n12 1 0 0\n9 2 1 2\n13 0 1 0 .5 .5\n14 1 1 0 .1 .1\n$EndNodes\n"
        "$Elements\n2 3\n1 0 15 1\n1 11\n9 2 2 2\n2 11 12 13\n3 12 14 13\n$EndElements\n");
    EXPECT_THAT(mesh.node_ids, ElementsAre(11, 12, 13, 14));
    EXPECT_EQ(mesh.points[3], Vec3(1, 1, 0));
    EXPECT_THAT(checks::members(mesh, "S", GroupKind::element), ElementsAre(2, 3));
    EXPECT_THAT(checks::members(mesh, "PhysicalPoint5", GroupKind::node), ElementsAre(11));
    EXPECT_THAT(checks::members(mesh, "PhysicalPoint6", GroupKind::node), ElementsAre(12));  // by its node alone
    EXPECT_EQ(remarks(mesh), ": the nodes' parametric coordinates are not read\n");
}

/// A tetrahedron and a node group in binary.
std::string binary41(bool swapped, int size_bytes) {
    Bytes b(swapped);
    const auto sizes = [&](std::initializer_list<std::int64_t> values) {
        for (const std::int64_t v : values)
            if (size_bytes == 8)
                b.put<std::int64_t>({v});
            else
                b.put<std::int32_t>({static_cast<std::int32_t>(v)});
    };
    b.text("$MeshFormat\n4.1 1 " + std::to_string(size_bytes) + "\n").put<std::int32_t>({1}).text("\n$EndMeshFormat\n");
    b.text("$PhysicalNames\n2\n0 3 \"TIP\"\n3 1 \"BODY\"\n$EndPhysicalNames\n$Entities\n");
    sizes({1, 0, 0, 1});
    b.put<std::int32_t>({5}).put<double>({0, 0, 1});
    sizes({1});
    b.put<std::int32_t>({3});
    b.put<std::int32_t>({6}).put<double>({0, 0, 0, 1, 1, 1});
    sizes({1});
    b.put<std::int32_t>({1});
    sizes({0});
    b.text("\n$EndEntities\n$Nodes\n");
    sizes({1, 4, 10, 13});
    b.put<std::int32_t>({3, 6, 0});
    sizes({4, 10, 11, 12, 13});
    b.put<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1});
    b.text("\n$EndNodes\n$Elements\n");
    sizes({2, 2, 7, 8});
    b.put<std::int32_t>({0, 5, 15});
    sizes({1, 7, 13});
    b.put<std::int32_t>({3, 6, 4});
    sizes({1, 8, 10, 11, 12, 13});
    b.text("\n$EndElements\n");
    return b.str();
}

/// Two triangles in binary, version 2.2, each in two groups.
std::string binary22(bool swapped) {
    Bytes b(swapped);
    b.text("$MeshFormat\n2.2 1 8\n").put<std::int32_t>({1}).text("\n$EndMeshFormat\n$Nodes\n4\n");
    for (std::int32_t n = 0; n < 4; ++n) b.put<std::int32_t>({n + 10}).put<double>({double(n % 2), n * 0.1, 0});
    b.text("\n$EndNodes\n$Elements\n4\n");
    b.put<std::int32_t>({2, 1, 2, 1, 5, 1, 10, 11, 12});
    b.put<std::int32_t>({2, 3, 2, 2, 6, 1, 10, 11, 12, 3, 5, 1, 11, 13, 12, 4, 6, 1, 11, 13, 12});
    b.text("\n$EndElements\n");
    return b.str();
}

TEST_F(MshReading, BinaryOfBothByteOrdersAndSizes) {
    for (const bool swapped : {false, true}) {
        for (const int bytes : {8, 4}) {
            const Mesh mesh = read(binary41(swapped, bytes));
            EXPECT_THAT(mesh.node_ids, ElementsAre(10, 11, 12, 13));
            EXPECT_EQ(mesh.points[3], Vec3(0, 0, 0.1));
            EXPECT_THAT(mesh.block(CellType::tetra).ids, ElementsAre(8));
            EXPECT_THAT(mesh.block(CellType::tetra).nodes(0), ElementsAre(0, 1, 2, 3));
            EXPECT_THAT(checks::members(mesh, "BODY", GroupKind::element), ElementsAre(8));
            EXPECT_THAT(checks::members(mesh, "TIP", GroupKind::node), ElementsAre(13));
        }
        const Mesh mesh = read(binary22(swapped));
        EXPECT_EQ(mesh.points[3], Vec3(1, 3 * 0.1, 0));
        EXPECT_THAT(mesh.block(CellType::triangle).ids, ElementsAre(1, 3));
        EXPECT_THAT(mesh.block(CellType::triangle).nodes(1), ElementsAre(1, 3, 2));
        EXPECT_THAT(checks::members(mesh, "PhysicalSurface5", GroupKind::element), ElementsAre(1, 3));
        EXPECT_THAT(checks::members(mesh, "PhysicalSurface6", GroupKind::element), ElementsAre(1, 3));
    }
    const std::string text = binary41(false, 8);
    const std::size_t nodes = text.find("$Nodes"), elements = text.find("$Elements");
    expect_error(text.substr(0, nodes + 111),
                 ": $Nodes, byte " + std::to_string(nodes + 107) + ": the file ends within");
    std::string damaged = text;
    damaged[elements + 10 + 32 + 8] = 29;  // the type of the first block
    EXPECT_THAT([&] { read(damaged); },
                ThrowsMessage<UnsupportedElementError>(
                    HasSubstr(": $Elements, byte " + std::to_string(elements + 50) +
                              ": elements of Gmsh's type 29 (20-node third order tetrahedron), which FemScalpel")));
    damaged = text;
    damaged[text.find("4.1 1 8") + 8] = 2;
    expect_error(damaged, ": $MeshFormat, byte 20: the byte order cannot be told");
}

TEST_F(MshReading, WhatIsNotReadIsTold) {
    const std::string elements = "$Elements\n1\n1 2 4 7 1 1 2 2 4 6\n$EndElements\n";
    const Mesh mesh = read(head22 + "$Comments\nthis and that\n$EndComments\n" + five_nodes + elements +
                           "$NodeData\n1\n\"T\"\n$EndNodeData\n$NodeData\n1\n\"U\"\n$EndNodeData\n$Periodic\n0\n"
                           "$EndPeriodic\n$Mine\n$EndMine\n");
    EXPECT_EQ(mesh.block(CellType::triangle).size(), 1);
    const std::string told = remarks(mesh);
    for (const char* line : {":4: the section $Comments is not read: comments\n",
                             ":19: the section $NodeData is not read: results in nodes (there are 2 of them)\n",
                             ":27: the section $Periodic is not read: which nodes are periodic\n",
                             ":30: the section $Mine is not read\n", ": the partitions of 1 elements are not read\n"})
        EXPECT_THAT(told, HasSubstr(line));
    EXPECT_EQ(std::ranges::count(told, '\n'), 5);
}

TEST_F(MshReading, NamesMayComeLastAndAgree) {
    const std::string elements = "$Elements\n2\n1 2 2 7 1 2 4 6\n2 4 2 8 1 2 4 6 8\n$EndElements\n";
    const Mesh mesh = read(head22 + five_nodes + elements +
                           "$PhysicalNames\n3\n2 7 \"W\"\n3 8 \"W\"\n2 9 \"PhysicalSurface7\"\n$EndPhysicalNames\n");
    ASSERT_EQ(mesh.groups.size(), 2u);
    EXPECT_THAT(checks::members(mesh, "W", GroupKind::element), ElementsAre(1, 2));
    const Mesh taken =
        read(head22 + "$PhysicalNames\n1\n3 9 \"PhysicalSurface7\"\n$EndPhysicalNames\n" + five_nodes + elements);
    EXPECT_THAT(checks::members(taken, "PhysicalSurface7", GroupKind::element), ElementsAre());
    EXPECT_THAT(checks::members(taken, "PhysicalSurface7_", GroupKind::element), ElementsAre(1));
}

TEST_F(MshReading, ErrorsNameTheLine) {
    const std::string triangle = "$Elements\n1\n1 2 0 2 4 6\n$EndElements\n";
    expect_error("", ":1: this is no mesh of Gmsh");
    expect_error("(0 \"Fluent\")\n", ":1: this is no mesh of Gmsh");
    expect_error("$NOD\n1\n", ":1: files of Gmsh's version 1 are not read");
    expect_error("$MeshFormat\n3 0 8\n$EndMeshFormat\n", ":2: version 3 of Gmsh's format is not read, but 2.0 to 2.2");
    expect_error("$MeshFormat\n4 1 8\n$EndMeshFormat\n", ":2: binary files of version 4.0 are not read");
    expect_error("$MeshFormat\n2.2 2 8\n$EndMeshFormat\n", ":2: the file type 2 is neither");
    expect_error("$MeshFormat\n2.2 1 4\n$EndMeshFormat\n", ":2: numbers of 4 bytes are not read");
    expect_error(head22, ": there are no nodes in this file");
    expect_error(head22 + "$Nodes\n0\n$EndNodes\n", "there are no nodes in this file");
    expect_error(head22 + triangle, ":4: the elements come before the nodes");
    expect_error(head22 + "here\n" + five_nodes, ":4: expected the start of a section, as $Nodes, not 'here'");
    expect_error(head22 + "$Nodes\n2\n1 0 0 0\n$EndNodes\n", ":7: the section $Nodes has fewer numbers than it says");
    expect_error(head22 + "$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n", ":7: expected $EndNodes, not '2'");
    expect_error(head22 + "$Nodes\n1\n1 0 0,5 0\n$EndNodes\n", ":6: expected a number, not '0,5'");
    expect_error(head22 + "$Nodes\n1\n1 0 inf 0\n$EndNodes\n", ":6: a coordinate is not a finite number");
    expect_error(head22 + "$Nodes\n1\n1 0 1e999 0\n$EndNodes\n", ":6: a number is too large");
    expect_error(head22 + "$Nodes\n1\n0 0 0 0\n$EndNodes\n", ":6: node number 0 is not positive");
    expect_error(head22 + "$Nodes\n999999999\n1 0 0 0\n$EndNodes\n",
                 ":5: the number 999999999 is more than the rest of the file can hold");
    expect_error(head22 + "$Nodes\n2\n7 0 0 0\n7 1 0 0\n$EndNodes\n", ":7: node number 7 is used twice");
    expect_error(head22 + five_nodes + "$Elements\n1\n1 2 0 2 4 7\n$EndElements\n",
                 ":14: element 1 names node 7, which the file does not define");
    expect_error(head22 + five_nodes + "$Elements\n1\n1 99 0 2 4 6\n$EndElements\n",
                 ":14: elements of Gmsh's type 99, which FemScalpel cannot hold");
    expect_error(head22 + five_nodes + "$Elements\n1\n1 21 0 2 4 6\n$EndElements\n", "(10-node third order triangle)");
    expect_error(head22 + five_nodes + "$Elements\n2\n3 2 0 2 4 6\n3 2 0 2 4 8\n$EndElements\n",
                 ":15: element number 3 is used twice");
    expect_error(head22 + five_nodes + triangle + triangle, ":16: there is a second section of elements");
    expect_error(head22 + five_nodes + "$Periodic\n1\n", ":12: the section $Periodic does not end");
    expect_error(head22 + "$PhysicalNames\n1\n2 1 A\n$EndPhysicalNames\n",
                 ":6: expected a dimension, a tag and a name");
    expect_error(head22 + "$PhysicalNames\n2\n2 1 \"A\"\n2 1 \"B\"\n$EndPhysicalNames\n", "has two names");
    const std::string nodes = "$Nodes\n1 1 1 1\n0 1 0 1\n1\n0 0 0\n$EndNodes\n";
    expect_error(head41 + "$Nodes\n1 2 1 2\n0 1 0 1\n1\n0 0 0\n$EndNodes\n",
                 ":8: the blocks have 1 nodes, but the section says 2");
    expect_error(head41 + "$Nodes\n1 1 1 1\n4 1 0 1\n1\n0 0 0\n$EndNodes\n", ":6: there is no dimension 4");
    expect_error(head41 + nodes + "$Elements\n1 1 1 1\n0 1 15 2\n1 1\n2 1\n$EndElements\n",
                 ":12: a block of 2 elements, but 1 are left");
    expect_error(head41 + nodes + "$Elements\n1 1 1 1\n2 1 15 1\n1 1\n$EndElements\n",
                 ":12: elements of type vertex in an entity of dimension 2");
    expect_error(head41 + "$Entities\n2 0 0 0\n1 0 0 0 0\n1 0 0 0 0\n$EndEntities\n" + nodes,
                 ":7: the entity of dimension 0 and tag 1 is there twice");
}

TEST_F(MshReading, DamagedFilesGiveAMeshOrAReadError) {
    write_msh(checks::one_of_each({CellType::triangle7}), path_);
    std::ifstream in(path_);
    const std::string own(std::istreambuf_iterator<char>(in), {});
    const std::string old = head22 + "$PhysicalNames\n2\n2 1 \"A\"\n3 2 \"B\"\n$EndPhysicalNames\n" + five_nodes +
                            "$Elements\n4\n1 15 2 4 1 2\n3 2 2 1 5 2 4 6\n4 2 2 2 5 2 4 6\n5 4 2 2 1 2 4 6 8\n"
                            "$EndElements\n$Periodic\n0\n$EndPeriodic\n";
    checks::Random random(5);
    for (const std::string& whole : {own, old, binary41(false, 8), binary41(true, 4), binary22(false)})
        read_damaged(whole, 1500, "0123456789-.$ \n\"e", random);
    EXPECT_GT(read_well_, 500);
    EXPECT_GT(refused_, 500);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
