// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/cad_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepTools.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "error.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::HasSubstr;

int faces_of(const TopoDS_Shape& shape) {
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    return faces.Extent();
}

std::string box() {
    std::ostringstream text;
    BRepTools::Write(BRepPrimAPI_MakeBox(1, 2, 3).Shape(), text);
    return text.str();
}

struct CadFile : testing::Test {
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
    fs::path with(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }
    fs::path folder = fs::temp_directory_path() / ("femscalpel_cad_" + std::to_string(::getpid()));
};

TEST_F(CadFile, IsReadByItsSuffix) {
    EXPECT_EQ(faces_of(read_cad_file(with("box.brep", box()))), 6);
    EXPECT_EQ(faces_of(read_cad_file(with("box.BRP", box()))), 6) << "case does not count";
    EXPECT_EQ(faces_of(shape_from_brep(box(), "face")), 6);
}

TEST_F(CadFile, IsNamedInErrors) {
    const auto error = [](const fs::path& path) {
        try {
            read_cad_file(path);
        } catch (const ReadError& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    EXPECT_THAT(error(folder / "none.brep"), HasSubstr("none.brep' is not a file"));
    EXPECT_THAT(error(with("box.iges", box())), HasSubstr("the suffix is '.iges'"));
    EXPECT_THAT(error(with("bad.step", "nothing")), HasSubstr("bad.step' is not a STEP file"));
    EXPECT_THAT(error(with("bad.brep", "nothing")), HasSubstr("bad.brep'"));
    EXPECT_THAT([] { shape_from_brep("nothing", "skin"); },
                testing::ThrowsMessage<ToolError>(testing::StartsWith("skin: ")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
