// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/formats.h"

#include <unistd.h>

#include <filesystem>
#include <set>

#include "io/io.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Formats, AreToldByTheExtensionWhateverItsCase) {
    for (const Format& f : formats())
        for (const std::string_view e : f.extensions()) {
            EXPECT_EQ(format_of("a/b.c/mesh" + std::string(e)), &f) << e;
            std::string upper(e);
            for (char& c : upper) c = static_cast<char>(std::toupper(c));
            EXPECT_EQ(format_of("mesh.old" + upper), &f) << upper;
        }
    EXPECT_EQ(format_of("mesh.inp.gz"), format_of("mesh.inp"));
    EXPECT_NE(format_of("mesh.med"), format_of("mesh.inp"));
    for (const char* name : {"mesh", "med", ".med", "mesh.", "mesh.gz", "mesh.med.gz", "mesh.inp.bz2", "a.med/mesh"})
        EXPECT_EQ(format_of(name), nullptr) << name;
}

TEST(Formats, HaveAnExtensionEachOfTheirOwnAndAreGoodForSomething) {
    std::set<std::string_view> seen;
    for (const Format& f : formats()) {
        EXPECT_FALSE(f.title.empty());
        EXPECT_FALSE(f.extensions().empty()) << f.title;
        EXPECT_TRUE(f.read || f.write) << f.title;
        for (const std::string_view e : f.extensions()) {
            EXPECT_TRUE(e.starts_with('.')) << e;
            EXPECT_TRUE(seen.insert(e).second) << e;
        }
    }
    EXPECT_THAT(extensions_read(), testing::StartsWith(".med, .mmed, .rmed, .inp, .inp.gz, .vtu, .msh, .unv"));
    EXPECT_THAT(extensions_written(), testing::StartsWith(".med, .mmed, .rmed, .inp, .inp.gz, .vtu"));
}

TEST(Formats, ReadGivesBackWhatWriteWrote) {
    const Mesh mesh = checks::grid(2, 1, 1);
    const fs::path folder = fs::temp_directory_path() / ("femscalpel_formats_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    int both = 0;
    for (const Format& f : formats())
        for (const std::string_view e : f.extensions()) {
            if (!f.write) continue;
            const fs::path path = folder / ("mesh" + std::string(e));
            write(mesh, path);
            EXPECT_GT(fs::file_size(path), 100u) << e;
            if (!f.read) {
                EXPECT_THAT([&] { read(path); },
                            ThrowsMessage<ReadError>(HasSubstr("files of this kind can only be written; those that "
                                                               "can be read are " +
                                                               extensions_read())));
                continue;
            }
            ++both;
            const Mesh back = read(path);
            EXPECT_EQ(back.points, mesh.points) << e;
            EXPECT_EQ(back.node_ids, mesh.node_ids) << e;
            EXPECT_EQ(back.block(CellType::tetra).connectivity, mesh.block(CellType::tetra).connectivity) << e;
        }
    EXPECT_GE(both, 3);
    EXPECT_THAT([&] { write(mesh, folder / "mesh.xyz"); },
                ThrowsMessage<WriteError>(
                    HasSubstr("mesh.xyz: the format is told by the extension, one of " + extensions_written())));
    EXPECT_FALSE(fs::exists(folder / "mesh.xyz"));
    fs::remove_all(folder);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
