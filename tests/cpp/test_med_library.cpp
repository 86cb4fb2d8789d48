// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/med_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "io/med.h"
#include "io/med_soundness.h"
#include "mesh/cell_type.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;

TEST(MedType, OrdersEachNodeOnce) {
    std::set<med_geometry_type> known;
    for (const CellTraits& t : all_cell_types()) {
        const MedType& med = med_type(t.type);
        EXPECT_TRUE(known.insert(med.geometry).second);
        EXPECT_EQ(med.geometry % 100, t.nodes) << "MED's codes end with the number of nodes";
        std::set<int> order(med.order.begin(), med.order.begin() + t.nodes);
        EXPECT_EQ(static_cast<int>(order.size()), t.nodes) << t.name;
        EXPECT_EQ(*order.rbegin(), t.nodes - 1) << t.name;
        // Middles of edges go where their ends go.
        const auto place = [&](int node) {
            return std::find(med.order.begin(), med.order.begin() + t.nodes, node) - med.order.begin();
        };
        if (t.quadratic)
            for (std::size_t e = 0; e < t.edges.size(); ++e) {
                const auto a = place(t.edges[e][0]), b = place(t.edges[e][1]);
                const auto same = std::ranges::find_if(t.edges, [&](const auto& other) {
                    return std::minmax<long>(other[0], other[1]) == std::minmax<long>(a, b);
                });
                ASSERT_NE(same, t.edges.end()) << t.name;
                EXPECT_EQ(place(t.corners + static_cast<int>(e)), t.corners + (same - t.edges.begin())) << t.name;
            }
    }
}

struct MedFiles : testing::Test {
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder = fs::temp_directory_path() / ("femscalpel_med_" + std::to_string(::getpid()));
};

TEST_F(MedFiles, AreSoundAsWritten) {
    const QuietHdf5 quiet;
    const std::string path = folder / "cube.med";
    write_med(checks::grid(2, 2, 2), path);
    const auto lock = lock_libraries();
    EXPECT_TRUE(is_sound_med(path));
    EXPECT_FALSE(is_sound_med(folder / "none.med"));
    std::ofstream(folder / "text.med") << "no HDF5 file";
    EXPECT_FALSE(is_sound_med(folder / "text.med"));
    const med_idt id = MEDfileOpen(path.c_str(), MED_ACC_RDONLY);
    ASSERT_GE(id, 0);
    MedFile file(id);
    EXPECT_EQ(file.id(), id);
    EXPECT_TRUE(file.close());
    EXPECT_EQ(file.id(), -1);
    EXPECT_TRUE(file.close()) << "once more is nothing";
}

TEST_F(MedFiles, WithNamesTooLongForTheLibraryAreNot) {
    const QuietHdf5 quiet;
    const std::string path = folder / "cube.med";
    write_med(checks::grid(1, 1, 1), path);
    const auto lock = lock_libraries();
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    const hid_t group = H5Gcreate2(file, ("ENS_MAA/" + std::string(MED_NAME_SIZE + 1, 'A')).c_str(), H5P_DEFAULT,
                                   H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(group, 0);
    H5Gclose(group);
    H5Fclose(file);
    EXPECT_FALSE(is_sound_med(path));
}

/// As files of MED 2 are: their headers have no checksum that would tell of the damage.
void write_old_attributes(const fs::path& path, const std::vector<const char*>& names) {
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t meshes = H5Gcreate2(file, "ENS_MAA", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate(H5S_SCALAR);
    for (const char* name : names) {
        const hid_t one = H5Acreate2(meshes, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT);
        const int value = 1;
        EXPECT_GE(H5Awrite(one, H5T_NATIVE_INT, &value), 0);
        H5Aclose(one);
    }
    const hid_t mesh = H5Gcreate2(meshes, "mesh", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Gclose(mesh);
    H5Sclose(space);
    H5Gclose(meshes);
    H5Fclose(file);
}

TEST_F(MedFiles, WithDamagedAttributesAreNot) {
    const QuietHdf5 quiet;
    const fs::path path = folder / "old.med";
    const std::vector<const char*> names{"DIM", "NXT", "NXI", "TYP", "SRT", "REP", "ESP"};
    const auto lock = lock_libraries();
    for (const std::string name : names) {
        write_old_attributes(path, names);
        EXPECT_TRUE(is_sound_med(path));  // HDF5 keeps its table of attributes, and takes that for the next file's
        std::ifstream file(path, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(file), {}};
        const std::size_t at = text.find(name + '\0');
        ASSERT_NE(at, std::string::npos) << name;
        ASSERT_EQ(text[at - 8], 1) << "the version of the attribute's message";
        text[at - 8] = 99;
        std::ofstream(path, std::ios::binary) << text;
        EXPECT_FALSE(is_sound_med(path)) << name;
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
