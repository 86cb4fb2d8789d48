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
#include "io/med_structure.h"
#include "io/quiet_libraries.h"
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

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

struct MedFiles : testing::Test {
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder = fs::temp_directory_path() / ("femscalpel_med_" + std::to_string(::getpid()));
};

bool is_sound(const fs::path& path) { return MedSoundness(path).of_mesh(); }

TEST_F(MedFiles, AreSoundAsWritten) {
    const QuietLibraries quiet;
    const std::string path = folder / "cube.med";
    write_med(checks::grid(2, 2, 2), path);
    const auto lock = lock_libraries();
    EXPECT_TRUE(is_sound(path));
    EXPECT_FALSE(is_sound(folder / "none.med"));
    std::ofstream(folder / "text.med") << "no HDF5 file";
    EXPECT_FALSE(is_sound(folder / "text.med"));
    const med_idt id = MEDfileOpen(path.c_str(), MED_ACC_RDONLY);
    ASSERT_GE(id, 0);
    MedFile file(id);
    EXPECT_EQ(file.id(), id);
    EXPECT_TRUE(file.close());
    EXPECT_EQ(file.id(), -1);
    EXPECT_TRUE(file.close()) << "once more is nothing";
}

TEST_F(MedFiles, WithNamesTooLongForTheLibraryAreNot) {
    const QuietLibraries quiet;
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
    EXPECT_FALSE(is_sound(path));
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
    const QuietLibraries quiet;
    const fs::path path = folder / "old.med";
    const std::vector<const char*> names{"DIM", "NXT", "NXI", "TYP", "SRT", "REP", "ESP"};
    const auto lock = lock_libraries();
    for (const std::string name : names) {
        write_old_attributes(path, names);
        EXPECT_TRUE(is_sound(path));  // HDF5 keeps its table of attributes, and takes that for the next file's
        std::string text = content(path);
        const std::size_t at = text.find(name + '\0');
        ASSERT_NE(at, std::string::npos) << name;
        ASSERT_EQ(text[at - 8], 1) << "the version of the attribute's message";
        text[at - 8] = 99;
        std::ofstream(path, std::ios::binary) << text;
        EXPECT_FALSE(is_sound(path)) << name;
    }
}

TEST_F(MedFiles, AreOldOrNot) {
    const std::string path = folder / "a.med";
    write_med(checks::grid(1, 1, 1), path);
    EXPECT_FALSE(is_old_hdf5(path));
    write_old_attributes(path, {"DIM"});
    EXPECT_TRUE(is_old_hdf5(path));
    const std::string text = content(path);
    for (const std::size_t block : {512, 1024, 2048}) {
        std::ofstream(path, std::ios::binary) << std::string(block, ' ') << text;
        EXPECT_TRUE(is_old_hdf5(path)) << block;
    }
    std::ofstream(path, std::ios::binary) << std::string(600, ' ') << text;
    EXPECT_FALSE(is_old_hdf5(path)) << "no HDF5 file";
    EXPECT_FALSE(is_old_hdf5(folder / "none.med"));
    EXPECT_FALSE(is_old_hdf5(folder));
}

/// The one data set of an old file, in pieces of 100.
void write_old_pieces(const fs::path& path) {
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    for (const char* name : {"ENS_MAA", "CHA"}) {
        const hid_t group = H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        const hsize_t count = 1000, piece = 100;
        const hid_t space = H5Screate_simple(1, &count, nullptr), properties = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_chunk(properties, 1, &piece);
        const hid_t set = H5Dcreate2(group, "COO", H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
        const std::vector<double> values(count, 1.25);
        EXPECT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
        H5Dclose(set);
        H5Pclose(properties);
        H5Sclose(space);
        H5Gclose(group);
    }
    H5Fclose(file);
}

TEST_F(MedFiles, OfOldAreLookedAtAsAWhole) {
    const QuietLibraries quiet;
    const fs::path path = folder / "old.med";
    const auto lock = lock_libraries();
    write_old_pieces(path);
    EXPECT_TRUE(MedSoundness(path).of_mesh());
    EXPECT_TRUE(MedSoundness(path).of_fields());
    std::string text = content(path);
    // The tree that says where the pieces are: its kind is 1, groups' trees are of kind 0.
    using std::string_literals::operator""s;
    const auto spoil = [&](std::size_t at) {
        std::string damaged = text;
        damaged.replace(at, 4, "EERT");
        std::ofstream(path, std::ios::binary) << damaged;
    };
    const std::size_t first = text.find("TREE\1"s), second = text.find("TREE\1"s, first + 1);
    ASSERT_NE(second, text.npos);
    spoil(first);
    EXPECT_FALSE(MedSoundness(path).of_mesh());
    EXPECT_FALSE(MedSoundness(path).of_fields());
    EXPECT_TRUE(is_sound_structure(path, MedPart::mesh, MedLook::structure)) << "which does not look at the data";
    spoil(second);
    MedSoundness soundness(path);
    EXPECT_TRUE(soundness.of_mesh());
    EXPECT_FALSE(soundness.of_fields());
}

/// An old file whose one data set has `size` entries, and says that they are of `counted` things.
void write_old_counted(const fs::path& path, const std::string& groups, const char* set, hsize_t size, int counted) {
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t links = H5Pcreate(H5P_LINK_CREATE), scalar = H5Screate(H5S_SCALAR);
    H5Pset_create_intermediate_group(links, 1);
    const hid_t group = H5Gcreate2(file, groups.c_str(), links, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &size, nullptr);
    const hid_t data = H5Dcreate2(group, set, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t attribute = H5Acreate2(data, "NBR", H5T_STD_I32LE, scalar, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_INT, &counted), 0);
    H5Aclose(attribute);
    H5Dclose(data);
    H5Sclose(space);
    H5Gclose(group);
    H5Sclose(scalar);
    H5Pclose(links);
    H5Fclose(file);
}

TEST_F(MedFiles, OfOldHaveAsManyEntriesAsTheySay) {
    const QuietLibraries quiet;
    const std::string path = folder / "old.med";
    const auto lock = lock_libraries();
    const auto is_sound_with = [&](const char* groups, const char* set, hsize_t size, int counted) {
        write_old_counted(path, groups, set, size, counted);
        EXPECT_TRUE(is_sound_structure(path, MedPart::mesh, MedLook::structure));
        return is_sound_structure(path, MedPart::mesh, MedLook::everything);
    };
    EXPECT_TRUE(is_sound_with("ENS_MAA/M/NOE", "FAM", 4, 4));
    EXPECT_FALSE(is_sound_with("ENS_MAA/M/NOE", "FAM", 260, 4));
    EXPECT_FALSE(is_sound_with("ENS_MAA/M/NOE", "FAM", 3, 4));
    EXPECT_FALSE(is_sound_with("ENS_MAA/M/NOE", "NUM", 4, -4));
    EXPECT_FALSE(is_sound_with("ENS_MAA/M/NOE", "NUM", 4, 0));
    EXPECT_TRUE(is_sound_with("ENS_MAA/M/NOE", "COO", 12, 4));
    EXPECT_FALSE(is_sound_with("ENS_MAA/M/NOE", "COO", 16, 4));
    EXPECT_FALSE(is_sound_with("ENS_MAA/M/NOE", "COO", 11, 4));
    EXPECT_TRUE(is_sound_with("ENS_MAA/M/MAI/TE4", "NOD", 8, 2));
    EXPECT_FALSE(is_sound_with("ENS_MAA/M/MAI/TE4", "NOD", 12, 2));
    EXPECT_TRUE(is_sound_with("ENS_MAA/M/MAI/H20", "NOD", 40, 2));
    EXPECT_TRUE(is_sound_with("ENS_MAA/M/MAI/POG", "NOD", 40, 9)) << "of polygons, which are not read";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
