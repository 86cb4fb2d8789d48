// SPDX-License-Identifier: LGPL-2.1-or-later
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "format_testing.h"
#include "io/vtu.h"
#include "random_numbers.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Files that VTK and meshio wrote are in tests/python/test_vtu_reader.py.
class VtuReading : public checks::TextReading {
protected:
    VtuReading() : TextReading([](const fs::path& path) { return read_vtu(path); }, ".vtu") {}
};

std::string array(const std::string& type, const std::string& name, const std::string& values,
                  const std::string& more = "format=\"ascii\"") {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" " + more + ">" + values + "</DataArray>\n";
}

/// A text file of four points; its parts can be replaced.
struct Text {
    std::string head = "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">";
    std::string points = array("Float32", "Points", "0 0 0 1 0 0 0 1 0 0 0 1.5e0");
    std::string connectivity = array("Int32", "connectivity", "0 1 2 3 0 1");
    std::string offsets = array("Int32", "offsets", "4 6");
    std::string types = array("UInt8", "types", "10 3");
    std::string point_data, cell_data;

    std::string str() const {
        return "<?xml version=\"1.0\"?>\n" + head +
               "\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" NumberOfCells=\"2\">\n<Points>\n" + points +
               "</Points>\n<Cells>\n" + connectivity + offsets + types + "</Cells>\n<PointData>\n" + point_data +
               "</PointData>\n<CellData>\n" + cell_data + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    }
};

TEST_F(VtuReading, WhatWriteVtuWroteComesBackExactly) {
    Mesh mesh = checks::one_of_each({});
    mesh.add_group("FIX", GroupKind::facet);
    mesh.add_group("a<b> & \"c\"", GroupKind::element);
    mesh.add_group("Family", GroupKind::node);
    mesh.add_group("one face", GroupKind::facet);
    const auto number = [&](CellType type) { return mesh.block(type).ids[0]; };
    set_group_members(mesh, 7,
                      {GroupKind::facet,
                       {number(CellType::quad), number(CellType::hexahedron), number(CellType::hexahedron)},
                       {2, 1, 6}});
    set_group_members(mesh, 9, {GroupKind::node, {993}, {}});
    set_group_members(mesh, 10, {GroupKind::facet, {number(CellType::wedge)}, {1}});
    write_vtu(mesh, path_);
    const Mesh back = read_vtu(path_);
    ASSERT_EQ(back.groups.size(), mesh.groups.size());
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {  // those of nodes first, as the file has them
        const Group& group = mesh.groups[g];
        const auto found = back.find_group(group.name, group.kind);
        ASSERT_TRUE(found) << group.name;
        const GroupMembers a = group_members(back, *found), b = group_members(mesh, static_cast<GroupIndex>(g));
        EXPECT_EQ(a.ids, b.ids) << group.name;
        EXPECT_EQ(a.faces, b.faces) << group.name;
    }
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.node_ids, mesh.node_ids);
    for (const CellBlock& block : mesh.blocks()) {
        EXPECT_EQ(back.block(block.type).ids, block.ids);
        EXPECT_EQ(back.block(block.type).connectivity, block.connectivity) << traits(block.type).name;
    }
    EXPECT_THAT(back.remarks, testing::IsEmpty());
    EXPECT_NO_THROW(back.validate());
}

TEST_F(VtuReading, TextWithForeignArrays) {
    Text text;
    text.point_data = array("Int32", "NodeNumber", "1 1 2 3") + array("Float64", "T", "1 2 3 4");
    text.cell_data = array("Int64", "ElementNumber", "9 7");
    const Mesh mesh = read(text.str());
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 4));
    EXPECT_EQ(mesh.points[3], Vec3(0, 0, 1.5));
    EXPECT_THAT(mesh.block(CellType::tetra).ids, ElementsAre(9));
    EXPECT_THAT(mesh.block(CellType::line).ids, ElementsAre(7));
    EXPECT_THAT(mesh.block(CellType::line).nodes(0), ElementsAre(0, 1));
    EXPECT_THAT(mesh.remarks, ElementsAre(path_.string() + ": the data arrays 'NodeNumber', 'T' are not read"));
}

TEST_F(VtuReading, ElementsWithinArraysArePassedOver) {
    Text text;
    const std::string key =
        "<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\"><Value>7</Value></InformationKey>";
    text.points = array("Float32", "Points", "0 0 0 1 0 0 0 1 0 0 0 1.5e0\n" + key + "\n" + key);
    text.types = array("UInt8", "types", "\n" + key + "\n10 3\n" + key);
    text.cell_data = array("Int64", "first", "9 7" + key) + array("Int64", "ElementNumber", "9 7");
    EXPECT_THAT(read(text.str()).block(CellType::tetra).ids, ElementsAre(9));
}

TEST_F(VtuReading, Base64OfBothByteOrders) {
    Text text;
    text.types = array("UInt8", "types", "\n AgAA\nAAoD \n", "format=\"binary\"");  // length and values together
    EXPECT_EQ(read(text.str()).block(CellType::tetra).size(), 1);
    text.types = array("UInt8", "types", "AgAAAA==CgM=", "format=\"binary\"");  // apart
    EXPECT_EQ(read(text.str()).block(CellType::tetra).size(), 1);
    text.head = "<VTKFile type=\"UnstructuredGrid\" byte_order=\"BigEndian\">";
    text.types = array("UInt8", "types", "AAAAAgoD", "format=\"binary\"");
    text.offsets = array("Int16", "offsets", "AAAABAAEAAY=", "format=\"binary\"");
    EXPECT_EQ(read(text.str()).block(CellType::tetra).size(), 1);
    text.head = "<VTKFile type=\"UnstructuredGrid\" byte_order=\"BigEndian\" header_type=\"UInt64\">";
    expect_error(text.str(), "the array 'types' of Cells is truncated or damaged");
}

TEST_F(VtuReading, ErrorsNameTheLine) {
    const auto with = [](std::string Text::*part, const std::string& value) {
        Text text;
        text.*part = value;
        return text.str();
    };
    expect_error("", ":1: this is no VTK file of an unstructured grid");
    expect_error("<VTKFile type=\"UnstructuredGrid\"><a></b>", ":1: mismatched tag");
    expect_error("no xml", ":1: ");
    expect_error("<VTKFile type=\"PolyData\">",
                 ":1: this is no VTK file of an unstructured grid, but of the type 'PolyData'");
    expect_error("<VTKFile type=\"UnstructuredGrid\"></VTKFile>", "the grid has no piece");
    Text whole;
    std::string text = whole.str();
    text.insert(text.find("</UnstructuredGrid>"), "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>");
    expect_error(text, "the grid has several pieces");
    text = whole.str();
    text.replace(text.find("NumberOfPoints=\"4"), 17, "NumberOfPoints=\"x");
    expect_error(text, ":4: the piece has no NumberOfPoints that is a number");
    text = whole.str();
    text.replace(text.find("NumberOfCells=\"2"), 16, "NumberOfCells=\"99999999");
    expect_error(text, "more nodes or elements than it can hold");
    expect_error(with(&Text::head, "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\">"),
                 "compressed by vtkLZ4DataCompressor are not read");
    expect_error(with(&Text::types, ""), "the file has no array 'types' of Cells");
    expect_error(with(&Text::types, array("UInt8", "types", "10")),
                 ":11: the array 'types' of Cells has 1 values, not 2");
    expect_error(with(&Text::types, array("UInt8", "types", "10 3 3")), "has more than 2 values");
    expect_error(with(&Text::types, array("UInt8", "types", "10 x")), "has the entry 'x', which is no whole number");
    expect_error(with(&Text::types, array("Float32", "types", "10 3")), "has values of the type 'Float32', not whole");
    expect_error(with(&Text::types, array("UInt8", "types", "10 3", "format=\"odd\"")), "has the format 'odd'");
    expect_error(with(&Text::types, array("UInt8", "types", "", "format=\"appended\" offset=\"7\"")),
                 "has no offset within the appended data");
    expect_error(with(&Text::types, array("UInt8", "types", "10 7")), "cell 1 is of VTK's type 7, which FemScalpel");
    expect_error(with(&Text::offsets, array("Int32", "offsets", "3 6")),
                 ":10: the array 'offsets' of Cells gives cell 0, a tetra, 3 nodes");
    expect_error(with(&Text::offsets, array("Int32", "offsets", "4 9")), "gives cell 1, a line, 5 nodes");
    expect_error(with(&Text::connectivity, array("Int32", "connectivity", "0 1 2 4 0 1")),
                 ":9: the array 'connectivity' of Cells gives cell 0 the point 4 of 4");
    expect_error(with(&Text::points, array("Float32", "Points", "0 0 0 1 0 0 0 1 0 0 0 nan")),
                 ":6: the array 'Points' of Points has a value that is not a finite number");
    expect_error(with(&Text::cell_data, array("UInt8", "A", "1 4",
                                              "format=\"ascii\" femscalpel_group=\"facet\" "
                                              "femscalpel_name=\"A\"")),
                 "names faces of element 2 that it has not");
}

TEST_F(VtuReading, DamagedFilesGiveAMeshOrAReadError) {
    write_vtu(checks::one_of_each({}), path_);
    std::ifstream in(path_, std::ios::binary);
    const std::string own(std::istreambuf_iterator<char>(in), {});
    Text other;
    other.types = array("UInt8", "types", "AgAAAA==CgM=", "format=\"binary\"");
    other.cell_data = array("UInt8", "A", "1 0", "format=\"ascii\" femscalpel_group=\"element\" femscalpel_name=\"A\"");
    checks::Random random(7);
    for (const std::string& file : {own, other.str()}) read_damaged(file, 3000, "0123456789-.<>/\"e=", random);
    EXPECT_GT(read_well_, 300);
    EXPECT_GT(refused_, 300);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
