// SPDX-License-Identifier: LGPL-2.1-or-later
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "io/vtu_bytes.h"
#include "io/vtu_file.h"
#include "io/vtu_types.h"
#include "io/vtu_xml.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::ElementsAre;

TEST(VtuParts, BytesOfBase64AndPlain) {
    for (const auto& [text, base64] : {std::pair{"YWJj\nZGU=Zg==", true}, std::pair{"abcdef", false}}) {
        VtuBytes bytes(text, base64);
        std::string out(6, '?');
        EXPECT_GE(bytes.left(), 6u);
        EXPECT_TRUE(bytes.read(out.data(), 2));
        EXPECT_TRUE(bytes.read(out.data() + 2, 4));
        EXPECT_EQ(out, "abcdef");
        EXPECT_FALSE(bytes.read(out.data(), 1));
    }
    char c = 0;
    for (const char* bad : {"YW", "Y===", "YW=j", "YW#j"}) EXPECT_FALSE(VtuBytes(bad, true).read(&c, 1)) << bad;
}

TEST(VtuParts, HeadOfTheXml) {
    const std::string xml =
        "<VTKFile type=\"UnstructuredGrid\" header_type=\"UInt64\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" "
        "NumberOfCells=\"1\">\n<PointData><DataArray Name=\"a>b\"> 1 </DataArray><DataArray Name=\"c\"/></PointData>"
        "</Piece></UnstructuredGrid><AppendedData encoding=\"raw\">";
    const VtuHead head = read_vtu_xml(xml, "f");
    EXPECT_EQ(head.points, 3);
    EXPECT_EQ(head.header_type, "UInt64");
    EXPECT_EQ(head.appended_encoding, "raw");
    ASSERT_EQ(head.arrays.size(), 2u);
    EXPECT_EQ(head.arrays[0].name(), "a>b");
    EXPECT_EQ(head.arrays[0].inside, " 1 ");
    EXPECT_EQ(head.arrays[1].inside, "");
    EXPECT_EQ(head.arrays[1].section, "PointData");
    EXPECT_EQ(head.arrays[1].line, 2);
}

TEST(VtuParts, FileGivesValues) {
    const fs::path path = fs::path(testing::TempDir()) / ("femscalpel_parts_" + std::to_string(::getpid()) + ".vtu");
    std::ofstream(path, std::ios::binary)
        << "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece "
           "NumberOfPoints=\"2\" NumberOfCells=\"0\"><PointData><DataArray type=\"Int16\" Name=\"a\" "
           "format=\"appended\" offset=\"0\"/><DataArray type=\"Float32\" Name=\"b\" format=\"ascii\">1 1e-320"
           "</DataArray></PointData></Piece></UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n _"
        << std::string("\4\0\0\0\1\0\xff\xff", 8) << "</AppendedData></VTKFile>";
    const VtuFile file(path);
    fs::remove(path);
    EXPECT_EQ(file.points(), 2);
    const VtuArray *a = file.find("PointData", "a"), *b = file.find("PointData", "b");
    ASSERT_TRUE(a && b);
    EXPECT_TRUE(VtuFile::is_integer(*a) && !VtuFile::is_integer(*b));
    EXPECT_THAT(file.integers(*a, 2), ElementsAre(1, -1));
    EXPECT_THAT(file.all_integers(*a, 5), ElementsAre(1, -1));
    EXPECT_THROW(file.integers(*a, 3), ReadError);
    EXPECT_THROW(file.all_integers(*a, 1), ReadError);
    EXPECT_THROW(file.integers(*b, 2), ReadError);
    EXPECT_THAT(file.reals(*b, 2), ElementsAre(1, testing::DoubleNear(0, 1e-300)));
    EXPECT_EQ(file.find("CellData", "a"), nullptr);
}

TEST(VtuParts, TypesDifferAndWedgesTurn) {
    EXPECT_EQ(std::set<int>(vtk_types.begin(), vtk_types.end()).size(), vtk_types.size());
    std::array<int, 6> wedge = {0, 1, 2, 3, 4, 5};
    turn_vtk_wedge(wedge.begin());
    EXPECT_THAT(wedge, ElementsAre(0, 2, 1, 3, 5, 4));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
