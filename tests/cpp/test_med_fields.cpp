// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/med_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "error.h"
#include "io/med.h"
#include "random_numbers.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// A file that the MED library wrote: two triangles, a tetrahedron, and fields that are added by hand.
class MedFields : public testing::Test {
protected:
    void SetUp() override {
        std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
        const std::vector<med_int> triangles{1, 2, 3, 1, 2, 4}, tetra{1, 2, 3, 4}, numbers{70, 80};
        const auto lock = lock_libraries();
        fid_ = MEDfileOpen(path_.c_str(), MED_ACC_CREAT);
        const std::string axes(3 * MED_SNAME_SIZE, ' ');
        good(MEDmeshCr(fid_, "M", 3, 3, MED_UNSTRUCTURED_MESH, "", "", MED_SORT_DTIT, MED_CARTESIAN, axes.c_str(),
                       axes.c_str()));
        good(MEDmeshNodeCoordinateWr(fid_, "M", -1, -1, 0, MED_FULL_INTERLACE, 4, points.data()));
        good(MEDmeshElementConnectivityWr(fid_, "M", -1, -1, 0, MED_CELL, MED_TRIA3, MED_NODAL, MED_FULL_INTERLACE, 2,
                                          triangles.data()));
        good(MEDmeshElementConnectivityWr(fid_, "M", -1, -1, 0, MED_CELL, MED_TETRA4, MED_NODAL, MED_FULL_INTERLACE, 1,
                                          tetra.data()));
    }
    void TearDown() override {
        if (fid_ >= 0) MEDfileClose(fid_);
        fs::remove(path_);
    }

    static void good(med_err result) { EXPECT_GE(result, 0); }

    void field(const char* name, med_field_type type = MED_FLOAT64, const char* mesh = "M") {
        good(MEDfieldCr(fid_, name, type, 2, "DX              DY", "mm              N", "s", mesh));
    }

    template <class T>
    void values(const char* name, med_int step, double time, med_entity_type entity, med_geometry_type geometry,
                const char* profile, const char* localization, med_int count, const std::vector<T>& values) {
        good(MEDfieldValueWithProfileWr(fid_, name, step, MED_NO_IT, time, entity, geometry, MED_COMPACT_STMODE,
                                        profile, localization, MED_FULL_INTERLACE, MED_ALL_CONSTITUENT, count,
                                        reinterpret_cast<const unsigned char*>(values.data())));
    }

    Mesh read() {
        if (fid_ >= 0) MEDfileClose(fid_);
        fid_ = -1;
        return read_med(path_);
    }

    med_idt fid_ = -1;
    fs::path path_ = fs::path(testing::TempDir()) / ("femscalpel_fields_" + std::to_string(::getpid()) + ".med");
};

TEST_F(MedFields, OnNodesAreReadStepByStep) {
    field("DEPL");
    values<double>("DEPL", 1, 0.5, MED_NODE, MED_NONE, "", "", 4, {1, 2, 3, 4, 5, 6, 7, 8});
    values<double>("DEPL", 2, 1.5, MED_NODE, MED_NONE, "", "", 4, {-1, -2, -3, -4, -5, -6, -7, -8});
    const Mesh mesh = read();
    ASSERT_TRUE(mesh.fields);
    ASSERT_EQ(mesh.fields->fields.size(), 1u);
    const Field& f = mesh.fields->fields[0];
    EXPECT_EQ(f.name, "DEPL");
    EXPECT_THAT(f.components, ElementsAre("DX", "DY"));
    EXPECT_THAT(f.units, ElementsAre("mm", "N"));
    EXPECT_EQ(f.time_unit, "s");
    ASSERT_EQ(f.steps.size(), 2u);
    EXPECT_EQ(f.steps[1].number, 2);
    EXPECT_EQ(f.steps[1].iteration, -1);
    EXPECT_EQ(f.steps[1].time, 1.5);
    ASSERT_EQ(f.steps[0].parts.size(), 1u);
    EXPECT_EQ(f.steps[0].parts[0].support, FieldSupport::node);
    EXPECT_THAT(*f.steps[0].parts[0].numbers, ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(f.steps[1].parts[0].reals, ElementsAre(-1, -2, -3, -4, -5, -6, -7, -8));
    EXPECT_TRUE(mesh.remarks.empty());
}

TEST_F(MedFields, OnElementsTheirNodesAndPointsAreRead) {
    const std::vector<med_int> second{2};
    const std::vector<double> element{0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0}, points{.25, .25, .25, .5, .25, .25},
        weights{.1, .2};
    good(MEDlocalizationWr(fid_, "TWO", MED_TETRA4, 3, element.data(), MED_FULL_INTERLACE, 2, points.data(),
                           weights.data(), MED_NO_INTERPOLATION, MED_NO_MESH_SUPPORT));
    good(MEDprofileWr(fid_, "SECOND", 1, second.data()));
    field("NUM", MED_INT32);
    values<std::int32_t>("NUM", -1, 0, MED_CELL, MED_TRIA3, "SECOND", "", 1, {7, -8});
    field("ELNO");
    values<double>("ELNO", -1, 0, MED_NODE_ELEMENT, MED_TETRA4, "", "", 1, {10, 11, 20, 21, 30, 31, 40, 41});
    field("ELGA");
    values<double>("ELGA", -1, 0, MED_CELL, MED_TETRA4, "", "TWO", 1, {1, 2, 3, 4});
    const Mesh mesh = read();
    ASSERT_TRUE(mesh.fields);
    ASSERT_EQ(mesh.fields->fields.size(), 3u) << mesh.remarks.size();
    const auto part = [&](const char* name) {
        return std::ranges::find(mesh.fields->fields, name, &Field::name)->steps.at(0).parts.at(0);
    };
    EXPECT_THAT(*part("NUM").numbers, ElementsAre(mesh.block(CellType::triangle).ids[1]));
    EXPECT_THAT(part("NUM").integers, ElementsAre(7, -8));
    EXPECT_EQ(part("NUM").profile, "SECOND");
    EXPECT_EQ(part("ELNO").support, FieldSupport::element_nodes);
    // MED's second and third corner of a tetrahedron are our third and second.
    EXPECT_THAT(mesh.block(CellType::tetra).connectivity, ElementsAre(0, 2, 1, 3));
    EXPECT_THAT(part("ELNO").reals, ElementsAre(10, 11, 30, 31, 20, 21, 40, 41));
    EXPECT_EQ(part("ELGA").support, FieldSupport::element_points);
    EXPECT_EQ(part("ELGA").points, 2);
    const FieldLocalization* const where = mesh.fields->localization("TWO");
    ASSERT_TRUE(where);
    EXPECT_THAT(where->element, ElementsAre(0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0));
    EXPECT_EQ(where->points, points);
    EXPECT_EQ(where->weights, weights);
    EXPECT_NO_THROW(validate(*mesh.fields, mesh));
}

TEST_F(MedFields, OfOtherMeshesAndKindsAreLeftOutWithAWord) {
    field("OTHER", MED_FLOAT64, "ANOTHER");
    values<double>("OTHER", -1, 0, MED_NODE, MED_NONE, "", "", 4, {1, 2, 3, 4, 5, 6, 7, 8});
    field("SHORT");
    values<double>("SHORT", -1, 0, MED_NODE, MED_NONE, "", "", 3, {1, 2, 3, 4, 5, 6});
    const Mesh mesh = read();
    EXPECT_FALSE(mesh.fields);
    ASSERT_EQ(mesh.remarks.size(), 1u);
    EXPECT_THAT(mesh.remarks[0],
                HasSubstr(path_.string() + ": field 'SHORT' is not read: it has values of 3 nodes, the mesh has 4"));
}

TEST_F(MedFields, InDamagedFilesAreReadOrLeftOut) {
    field("DEPL");
    for (med_int step = 1; step < 4; ++step)
        values<double>("DEPL", step, 0.5, MED_NODE, MED_NONE, "", "", 4, {1, 2, 3, 4, 5, 6, 7, 8});
    const std::vector<med_int> second{2};
    good(MEDprofileWr(fid_, "SECOND", 1, second.data()));
    field("NUM", MED_INT32);
    values<std::int32_t>("NUM", -1, 0, MED_CELL, MED_TRIA3, "SECOND", "", 1, {7, -8});
    read();
    std::ifstream in(path_, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    checks::Random random(5);
    int read_well = 0, left_out = 0, refused = 0;
    for (int round = 0; round < 300; ++round) {
        std::string bytes = whole;
        for (int k = 0; k < 1 + round % 8; ++k) bytes[random.bits() % bytes.size()] = static_cast<char>(random.bits());
        fs::remove(path_);
        std::ofstream(path_, std::ios::binary) << bytes;
        try {
            const Mesh mesh = read_med(path_);
            EXPECT_NO_THROW(mesh.fields ? validate(*mesh.fields, mesh) : void());
            ++(mesh.remarks.empty() ? read_well : left_out);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::StartsWith(path_.string() + ":"));
            ++refused;
        }
    }
    EXPECT_GT(read_well, 5);
    EXPECT_GT(left_out, 2);
    EXPECT_GT(refused, 2);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
