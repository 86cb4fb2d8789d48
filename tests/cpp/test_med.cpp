// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/med.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <med.h>
#include <unistd.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "error.h"

namespace fs = std::filesystem;

/// Called by the leak sanitizer, where there is one: HDF5 does not free everything it allocated for a
/// damaged file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\n"; }

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MedTest : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        directory_ = fs::path(testing::TempDir()) /
                     ("femscalpel_med_" + std::string(info->name()) + "_" + std::to_string(::getpid()));
        fs::remove_all(directory_);
        fs::create_directories(directory_);
        path_ = directory_ / "m.med";
    }
    void TearDown() override { fs::remove_all(directory_); }

    /// Expects `call` to throw an E whose message names the file and contains `text`.
    template <class E>
    void expect_error(const std::function<void()>& call, const std::string& text) const {
        try {
            call();
            FAIL() << "no error, expected: " << text;
        } catch (const E& e) {
            EXPECT_THAT(e.what(), HasSubstr(text));
            EXPECT_THAT(e.what(), HasSubstr(directory_.string()));
        }
    }

    fs::path directory_, path_;
};

/// Members of every group that is not hidden, by kind and name.
using Members = std::map<std::pair<GroupKind, std::string>, std::vector<Index>>;

Members members_of(const Mesh& mesh) {
    Members out;
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        if (mesh.groups[g].hidden) continue;
        auto ids = group_members(mesh, static_cast<GroupIndex>(g)).ids;
        std::ranges::sort(ids);
        EXPECT_TRUE(out.try_emplace({mesh.groups[g].kind, mesh.groups[g].name}, std::move(ids)).second);
    }
    return out;
}

void expect_same(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.unit, b.unit);
    ASSERT_EQ(a.node_count(), b.node_count());
    for (std::size_t i = 0; i < a.points.size(); ++i)
        for (int k = 0; k < 3; ++k)
            ASSERT_EQ(std::bit_cast<std::uint64_t>(a.points[i][k]), std::bit_cast<std::uint64_t>(b.points[i][k]));
    EXPECT_EQ(a.node_ids, b.node_ids);
    for (const CellTraits& t : all_cell_types()) {
        EXPECT_EQ(a.block(t.type).connectivity, b.block(t.type).connectivity) << t.name;
        EXPECT_EQ(a.block(t.type).ids, b.block(t.type).ids) << t.name;
    }
    EXPECT_EQ(members_of(a), members_of(b));
}

/// Elements of every type on random nodes, with random numbers and random overlapping groups.
Mesh random_mesh(std::mt19937& random, int groups = 40) {
    Mesh mesh;
    mesh.name = "Maillage d'\u00e9preuve";
    mesh.unit = "mm";
    std::vector<Index> numbers(4000);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<Index>(7 * i + 3);
    numbers.back() = std::numeric_limits<med_int>::max();
    std::ranges::shuffle(numbers, random);
    std::uniform_real_distribution<double> coordinate(-1e3, 1e3);
    for (std::size_t i = 0; i < 200; ++i)
        mesh.add_node({coordinate(random), std::ldexp(coordinate(random), -1000), -0.0}, numbers[i]);
    std::ranges::shuffle(numbers, random);
    std::size_t next = 0;
    std::vector<Index> nodes(200);
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<Index>(i);
    for (const CellTraits& t : all_cell_types())
        for (unsigned k = 0; k < 1 + random() % 30; ++k) {
            std::ranges::shuffle(nodes, random);
            mesh.add_cell(t.type, std::span(nodes).first(static_cast<std::size_t>(t.nodes)), numbers[next++]);
        }
    std::vector<GroupMembers> members;
    for (int g = 0; g < groups; ++g) {
        const GroupKind kind = g % 3 == 0 ? GroupKind::node : GroupKind::element;
        // Some names are shared between the kinds.
        mesh.add_group("G" + std::to_string(kind == GroupKind::node ? g / 3 : g), kind);
        members.push_back({kind, {}, {}});
        const unsigned one_in = 1 + random() % 20;
        const auto pick = [&](const std::vector<Index>& ids) {
            for (Index id : ids)
                if (random() % one_in == 0) members.back().ids.push_back(id);
        };
        if (kind == GroupKind::node)
            pick(mesh.node_ids);
        else
            for (const CellBlock& block : mesh.blocks()) pick(block.ids);
    }
    for (const auto& [name, kind] : {std::pair{std::string("empty"), GroupKind::node},
                                     {"empty", GroupKind::element},
                                     {"a name with blanks, 80 bytes long" + std::string(47, '.'), GroupKind::element},
                                     {"St\u00fctze \u2460 / <a&b>", GroupKind::node}}) {
        mesh.add_group(name, kind);
        members.push_back({kind, {}, {}});
    }
    members.back().ids = {mesh.node_ids[5]};
    members[members.size() - 2].ids = {mesh.block(CellType::wedge18).ids[0]};
    assign_groups(mesh, members);
    mesh.validate();
    return mesh;
}

TEST_F(MedTest, RoundTripKeepsEverything) {
    std::mt19937 random(20);
    for (int k = 0; k < 6; ++k) {
        const Mesh mesh = random_mesh(random, 8 * k);
        write_med(mesh, path_);
        const Mesh back = read_med(path_);
        expect_same(mesh, back);
        write_med(back, path_);
        expect_same(mesh, read_med(path_));
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator{}), 1);
}

TEST_F(MedTest, ManyOverlappingGroups) {
    Mesh mesh;
    for (Index i = 0; i < 6001; ++i) mesh.add_node({static_cast<double>(i), 0, 0}, i + 1);
    for (Index i = 0; i < 6000; ++i) mesh.add_cell(CellType::line, std::array<Index, 2>{i, i + 1}, i + 1);
    std::mt19937 random(5);
    std::vector<GroupMembers> members;
    for (int g = 0; g < 500; ++g) {
        mesh.add_group("GROUP_" + std::to_string(g), GroupKind::element);
        members.push_back({GroupKind::element, {}, {}});
        const Index first = 1 + random() % 5000;
        for (Index i = first; i < first + 800; ++i) members.back().ids.push_back(i);
    }
    assign_groups(mesh, members);
    write_med(mesh, path_);
    expect_same(mesh, read_med(path_));
}

TEST_F(MedTest, HiddenGroupsAreNotWritten) {
    Mesh mesh;
    mesh.add_node({0, 0, 0}, 1);
    mesh.add_cell(CellType::vertex, std::array<Index, 1>{0}, 1);
    mesh.add_group("card", GroupKind::element, true);
    mesh.add_group("mass", GroupKind::element);
    const std::vector<GroupMembers> members = {{GroupKind::element, {1}, {}}, {GroupKind::element, {1}, {}}};
    assign_groups(mesh, members);
    write_med(mesh, path_);
    const Mesh back = read_med(path_);
    ASSERT_EQ(back.groups.size(), 1u);
    EXPECT_EQ(back.groups[0].name, "mass");
    EXPECT_THAT(group_members(back, 0).ids, ElementsAre(1));
}

// --- Files as others write them, made through the MED library ------------------------------------------

struct RawMed {
    RawMed(const fs::path& path, unsigned space_dimension = 3, med_axis_type axes = MED_CARTESIAN,
           med_mesh_type type = MED_UNSTRUCTURED_MESH)
        : file(MEDfileOpen(path.c_str(), MED_ACC_CREAT)) {
        std::string names = "x               y               z               ";
        std::string units = "cm              cm              cm              ";
        names.resize(16 * space_dimension);
        units.resize(16 * space_dimension);
        const auto dimension = static_cast<med_int>(space_dimension);
        EXPECT_GE(MEDmeshCr(file, mesh, dimension, dimension, type, "", "", MED_SORT_DTIT, axes, names.c_str(),
                            units.c_str()),
                  0);
        EXPECT_GE(MEDfamilyCr(file, mesh, "FAMILLE_ZERO", 0, 0, ""), 0);
    }
    ~RawMed() { MEDfileClose(file); }

    /// Coordinates node by node.
    void nodes(const std::vector<double>& xyz, int dimension = 3) const {
        EXPECT_GE(MEDmeshNodeCoordinateWr(file, mesh, MED_NO_DT, MED_NO_IT, 0, MED_FULL_INTERLACE,
                                          static_cast<med_int>(xyz.size()) / dimension, xyz.data()),
                  0);
    }
    /// Connectivity element by element, nodes from 1.
    void elements(med_geometry_type type, const std::vector<med_int>& nodes) const {
        EXPECT_GE(MEDmeshElementConnectivityWr(file, mesh, MED_NO_DT, MED_NO_IT, 0, MED_CELL, type, MED_NODAL,
                                               MED_FULL_INTERLACE, static_cast<med_int>(nodes.size()) / (type % 100),
                                               nodes.data()),
                  0);
    }
    void numbers(med_entity_type entity, med_geometry_type type, const std::vector<med_int>& n) const {
        const auto count = static_cast<med_int>(n.size());
        EXPECT_GE(MEDmeshEntityNumberWr(file, mesh, MED_NO_DT, MED_NO_IT, entity, type, count, n.data()), 0);
    }
    void families(med_entity_type entity, med_geometry_type type, const std::vector<med_int>& f) const {
        const auto count = static_cast<med_int>(f.size());
        EXPECT_GE(MEDmeshEntityFamilyNumberWr(file, mesh, MED_NO_DT, MED_NO_IT, entity, type, count, f.data()), 0);
    }
    void family(med_int number, const std::vector<std::string>& groups) const {
        std::string names;
        for (const std::string& g : groups) names += g + std::string(MED_LNAME_SIZE - g.size(), ' ');
        const std::string name = "F" + std::to_string(number);
        EXPECT_GE(MEDfamilyCr(file, mesh, name.c_str(), number, static_cast<med_int>(groups.size()), names.c_str()), 0);
    }

    med_idt file;
    const char* mesh = "Mesh_1";
};

const std::vector<double> unit_square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

TEST_F(MedTest, WithoutNumbersAndFamilies) {
    {
        RawMed raw(path_);
        raw.nodes(unit_square);
        raw.elements(MED_TRIA3, {1, 2, 3, 1, 3, 4});
        raw.elements(MED_SEG2, {1, 2});
        raw.elements(MED_POINT1, {3});
    }
    const Mesh mesh = read_med(path_);
    EXPECT_EQ(mesh.name, "Mesh_1");
    EXPECT_EQ(mesh.unit, "cm");
    EXPECT_THAT(mesh.node_ids, ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(mesh.block(CellType::vertex).ids, ElementsAre(1));
    EXPECT_THAT(mesh.block(CellType::line).ids, ElementsAre(2));
    EXPECT_THAT(mesh.block(CellType::triangle).ids, ElementsAre(3, 4));
    EXPECT_THAT(mesh.block(CellType::triangle).connectivity, ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_THAT(mesh.groups, IsEmpty());
}

TEST_F(MedTest, TwoDimensionalIsPaddedWithZero) {
    {
        RawMed raw(path_, 2);
        raw.nodes({0, 1, 2, 3, 4, 5}, 2);
        raw.elements(MED_TRIA3, {1, 2, 3});
    }
    const Mesh mesh = read_med(path_);
    EXPECT_EQ(mesh.points[2], Vec3(4, 5, 0));
}

TEST_F(MedTest, NumbersThatRepeatBetweenTypesAreReplaced) {
    for (const bool repeat : {false, true}) {
        {
            RawMed raw(path_);
            raw.nodes(unit_square);
            raw.numbers(MED_NODE, MED_NONE, {40, 30, 20, 10});
            raw.elements(MED_TRIA3, {1, 2, 3, 1, 3, 4});
            raw.numbers(MED_CELL, MED_TRIA3, {1, 2});
            raw.elements(MED_SEG2, {1, 2});
            raw.numbers(MED_CELL, MED_SEG2, {repeat ? 1 : 9});
        }
        const Mesh mesh = read_med(path_);
        EXPECT_THAT(mesh.node_ids, ElementsAre(40, 30, 20, 10));
        EXPECT_THAT(mesh.block(CellType::line).ids, ElementsAre(repeat ? 1 : 9));
        const Index first = repeat ? 2 : 1;
        EXPECT_THAT(mesh.block(CellType::triangle).ids, ElementsAre(first, first + 1));
    }
}

TEST_F(MedTest, FamiliesBecomeGroupsOfTheirKind) {
    {
        RawMed raw(path_);
        raw.nodes(unit_square);
        raw.elements(MED_TRIA3, {1, 2, 3, 1, 3, 4});
        raw.family(3, {"BOTH"});
        raw.family(4, {"BOTH", "CORNER  "});
        raw.family(5, {"NO_NODE"});
        raw.family(-1, {"BOTH"});
        raw.family(-7, {"NO_FACE", "BOTH"});
        raw.families(MED_NODE, MED_NONE, {3, 0, 4, 0});
        raw.families(MED_CELL, MED_TRIA3, {0, -1});
    }
    const Members expected = {{{GroupKind::node, "BOTH"}, {1, 3}},
                              {{GroupKind::node, "CORNER"}, {3}},
                              {{GroupKind::node, "NO_NODE"}, {}},
                              {{GroupKind::element, "BOTH"}, {2}},
                              {{GroupKind::element, "NO_FACE"}, {}}};
    EXPECT_EQ(members_of(read_med(path_)), expected);
}

TEST_F(MedTest, UndeclaredFamilyIsAnError) {
    {
        RawMed raw(path_);
        raw.nodes(unit_square);
        raw.elements(MED_TRIA3, {1, 2, 3});
        raw.families(MED_CELL, MED_TRIA3, {-9});
    }
    expect_error<ReadError>([&] { read_med(path_); }, "TRIA3 elements are in family -9");
}

TEST_F(MedTest, BadContentIsNamed) {
    const auto with = [&](const std::function<void(const RawMed&)>& fill) {
        fs::remove(path_);
        const RawMed raw(path_);
        fill(raw);
    };
    with([](const RawMed& raw) {
        raw.nodes(unit_square);
        raw.elements(MED_TRIA3, {1, 2, 3, 1, 3, 5});
    });
    expect_error<ReadError>([&] { read_med(path_); }, "TRIA3 element 2 of that type refers to node 5 of 4");
    with([](const RawMed& raw) { raw.nodes({0, 0, std::nan("")}); });
    expect_error<ReadError>([&] { read_med(path_); }, "node 1 has a coordinate that is not a finite number");
    with([](const RawMed& raw) {
        raw.nodes(unit_square);
        raw.numbers(MED_NODE, MED_NONE, {1, 2, 2, 3});
    });
    expect_error<ReadError>([&] { read_med(path_); }, "node number 2 is used twice");
    with([](const RawMed&) {});
    expect_error<ReadError>([&] { read_med(path_); }, "has no nodes");
    with([](const RawMed& raw) {
        raw.nodes(unit_square);
        const med_int index[] = {1, 5}, nodes[] = {1, 2, 3, 4};
        const auto written =
            MEDmeshPolygonWr(raw.file, raw.mesh, MED_NO_DT, MED_NO_IT, 0, MED_CELL, MED_NODAL, 2, index, nodes);
        EXPECT_GE(written, 0);
    });
    expect_error<UnsupportedElementError>([&] { read_med(path_); }, "1 polygons (MED_POLYGON)");
    with([](const RawMed& raw) {
        raw.nodes(unit_square);
        raw.elements(MED_SEG4, {1, 2, 3, 4, 4, 3, 2, 1});
    });
    expect_error<UnsupportedElementError>([&] { read_med(path_); }, "2 SEG4 elements");
    fs::remove(path_);
    { const RawMed raw(path_, 3, MED_CYLINDRICAL); }
    expect_error<ReadError>([&] { read_med(path_); }, "cylindrical");
    fs::remove(path_);
    { const RawMed raw(path_, 3, MED_CARTESIAN, MED_STRUCTURED_MESH); }
    expect_error<ReadError>([&] { read_med(path_); }, "structured grids only");
}

// --- Node order ----------------------------------------------------------------------------------------

struct MedShape {
    CellType linear;
    std::vector<Vec3> corners;                   // in MED's order, a well-shaped element
    std::vector<std::array<int, 2>> edges;       // MED's mid-side nodes, as corners of MED
    std::vector<std::vector<int>> face_centres;  // MED's face centres, as corners of MED
    double volume;
};

const std::vector<MedShape> med_shapes = {
    {CellType::tetra,
     {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
     {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
     {},
     1. / 6},
    {CellType::pyramid,
     {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {.5, .5, 1}},
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
     {},
     1. / 3},
    {CellType::wedge,
     {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}},
     {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
     {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
     .5},
    {CellType::hexahedron,
     {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}},
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
     {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}},
     1},
};

Vec3 mean(const std::vector<Vec3>& points, std::span<const int> which) {
    Vec3 sum = Vec3::Zero();
    for (int i : which) sum += points[static_cast<std::size_t>(i)];
    return sum / static_cast<double>(which.size());
}

/// Volume from the corner faces, which the mesh says look inwards.
double volume(const CellTraits& t, const std::vector<Vec3>& p) {
    double six = 0;
    for (const auto& f : t.faces)
        for (int k = 1; k + 1 < (f[3] < 0 ? 3 : 4); ++k) six -= p[f[0]].dot(p[f[k]].cross(p[f[k + 1]]));
    return six / 6;
}

TEST_F(MedTest, VolumesTurnIntoTheMeshsNodeOrder) {
    // MED type and whether it has mid-side nodes and face centres.
    const std::tuple<CellType, med_geometry_type> types[] = {
        {CellType::tetra, MED_TETRA4},        {CellType::tetra10, MED_TETRA10},  {CellType::pyramid, MED_PYRA5},
        {CellType::pyramid13, MED_PYRA13},    {CellType::wedge, MED_PENTA6},     {CellType::wedge15, MED_PENTA15},
        {CellType::wedge18, MED_PENTA18},     {CellType::hexahedron, MED_HEXA8}, {CellType::hexahedron20, MED_HEXA20},
        {CellType::hexahedron27, MED_HEXA27},
    };
    for (const auto& [type, geometry] : types) {
        const CellTraits& t = traits(type);
        SCOPED_TRACE(t.name);
        const MedShape& shape = *std::ranges::find(med_shapes, t.linear, &MedShape::linear);
        std::vector<Vec3> nodes = shape.corners;
        if (t.quadratic)
            for (const auto& e : shape.edges) nodes.push_back(mean(shape.corners, e));
        for (std::size_t f = 0; static_cast<int>(nodes.size()) < t.nodes; ++f)
            nodes.push_back(mean(shape.corners, shape.face_centres[f]));
        ASSERT_EQ(static_cast<int>(nodes.size()), t.nodes);
        fs::remove(path_);
        {
            RawMed raw(path_);
            std::vector<double> xyz;
            std::vector<med_int> numbers;
            for (const Vec3& p : nodes) {
                xyz.insert(xyz.end(), p.data(), p.data() + 3);
                numbers.push_back(static_cast<med_int>(numbers.size()) + 1);
            }
            raw.nodes(xyz);
            raw.elements(geometry, numbers);
        }
        const Mesh mesh = read_med(path_);
        ASSERT_EQ(mesh.block(type).size(), 1);
        std::vector<Vec3> p;
        for (Index n : mesh.block(type).nodes(0)) p.push_back(mesh.points[static_cast<std::size_t>(n)]);
        EXPECT_NEAR(volume(t, p), shape.volume, 1e-12);
        for (std::size_t e = 0; t.quadratic && e < t.edges.size(); ++e)
            EXPECT_EQ(p[static_cast<std::size_t>(t.corners) + e],
                      mean(p, std::vector<int>{t.edges[e][0], t.edges[e][1]}));
        // VTK's order of face centres.
        const std::vector<std::vector<int>> wedge_centres = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
        const std::vector<std::vector<int>> hexahedron_centres = {{0, 3, 7, 4},
                                                                  {1, 2, 6, 5},
                                                                  {0, 1, 5, 4},
                                                                  {2, 3, 7, 6},
                                                                  {0, 1, 2, 3},
                                                                  {4, 5, 6, 7},
                                                                  {0, 1, 2, 3, 4, 5, 6, 7}};
        const std::size_t first = static_cast<std::size_t>(t.corners) + (t.quadratic ? t.edges.size() : 0);
        for (std::size_t f = 0; first + f < p.size(); ++f)
            EXPECT_EQ(p[first + f], mean(p, (type == CellType::wedge18 ? wedge_centres : hexahedron_centres)[f])) << f;

        // And back: MED's own order again.
        write_med(mesh, path_);
        const med_idt file = MEDfileOpen(path_.c_str(), MED_ACC_RDONLY);
        std::vector<med_int> stored(static_cast<std::size_t>(t.nodes));
        EXPECT_GE(MEDmeshElementConnectivityRd(file, "Mesh_1", MED_NO_DT, MED_NO_IT, MED_CELL, geometry, MED_NODAL,
                                               MED_FULL_INTERLACE, stored.data()),
                  0);
        MEDfileClose(file);
        for (std::size_t i = 0; i < stored.size(); ++i) EXPECT_EQ(stored[i], static_cast<med_int>(i) + 1);
    }
}

// --- Facets --------------------------------------------------------------------------------------------

/// Vector area of an element's corners.
Vec3 vector_area(const Mesh& mesh, CellType type, Index cell) {
    const auto nodes = mesh.block(type).nodes(cell);
    const auto at = [&](int i) { return mesh.points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(i)])]; };
    Vec3 sum = Vec3::Zero();
    for (int k = 1; k + 1 < traits(type).corners; ++k) sum += .5 * (at(k) - at(0)).cross(at(k + 1) - at(0));
    return sum;
}

TEST_F(MedTest, FacetsOfVolumesBecomeOutwardFaceElements) {
    const std::map<CellType, std::pair<CellType, CellType>> expected = {
        // type: its triangular and quadrangular face types
        {CellType::tetra, {CellType::triangle, CellType::quad}},
        {CellType::tetra10, {CellType::triangle6, CellType::quad8}},
        {CellType::pyramid, {CellType::triangle, CellType::quad}},
        {CellType::pyramid13, {CellType::triangle6, CellType::quad8}},
        {CellType::wedge, {CellType::triangle, CellType::quad}},
        {CellType::wedge15, {CellType::triangle6, CellType::quad8}},
        {CellType::wedge18, {CellType::triangle6, CellType::quad9}},
        {CellType::hexahedron, {CellType::triangle, CellType::quad}},
        {CellType::hexahedron20, {CellType::triangle6, CellType::quad8}},
        {CellType::hexahedron27, {CellType::triangle6, CellType::quad9}},
    };
    for (const auto& [type, faces] : expected) {
        const CellTraits& t = traits(type);
        SCOPED_TRACE(t.name);
        const MedShape& shape = *std::ranges::find(med_shapes, t.linear, &MedShape::linear);
        // The element in our order: mirror MED's corners.
        std::vector<Vec3> p = shape.corners;
        for (Vec3& x : p) x = Vec3(x.y(), x.x(), x.z());
        if (t.quadratic)
            for (const auto& e : t.edges) p.push_back(mean(p, std::vector<int>{e[0], e[1]}));
        if (type == CellType::wedge18)
            for (const auto& f : shape.face_centres) p.push_back(mean(p, f));
        if (type == CellType::hexahedron27)
            for (const auto& f : std::vector<std::vector<int>>{
                     {0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 2, 3}, {4, 5, 6, 7}, {0, 6}})
                p.push_back(mean(p, f));
        ASSERT_GT(volume(t, p), 0);
        Mesh mesh;
        std::vector<Index> nodes;
        for (const Vec3& x : p) nodes.push_back(mesh.add_node(x, mesh.node_count() + 1));
        mesh.add_cell(type, nodes, 55);
        Vec3 middle = Vec3::Zero();
        for (int c = 0; c < t.corners; ++c) middle += p[static_cast<std::size_t>(c)] / t.corners;
        for (int face = 1; face <= static_cast<int>(t.faces.size()); ++face) {
            mesh.groups.clear();
            mesh.facets.clear();
            mesh.families = FamilyTable();
            const GroupIndex g = mesh.add_group("SURFACE", GroupKind::facet);
            set_group_members(mesh, g, {GroupKind::facet, {55}, {face}});
            write_med(mesh, path_);
            const Mesh back = read_med(path_);
            const Members members = members_of(back);
            EXPECT_EQ(members, (Members{{{GroupKind::element, "SURFACE"}, {56}}}));
            const auto& corners = t.faces[static_cast<std::size_t>(face) - 1];
            const CellType face_type = corners[3] < 0 ? faces.first : faces.second;
            ASSERT_EQ(back.block(face_type).size(), 1);
            const Vec3 area = vector_area(back, face_type, 0);
            EXPECT_GT(area.norm(), 0.1);
            const auto cell = back.block(face_type).nodes(0);
            EXPECT_GT(area.dot(back.points[static_cast<std::size_t>(cell[0])] - middle), 0) << "face " << face;
            // The corners are the face's, and every other node lies where it should.
            std::vector<Vec3> q;
            for (Index n : cell) q.push_back(back.points[static_cast<std::size_t>(n)]);
            std::vector<Index> wanted, found(cell.begin(), cell.begin() + traits(face_type).corners);
            for (int c : corners)
                if (c >= 0) wanted.push_back(c);
            EXPECT_THAT(found, testing::UnorderedElementsAreArray(wanted));
            const CellTraits& ft = traits(face_type);
            for (std::size_t e = 0; ft.quadratic && e < ft.edges.size(); ++e)
                EXPECT_EQ(q[static_cast<std::size_t>(ft.corners) + e],
                          mean(q, std::vector<int>{ft.edges[e][0], ft.edges[e][1]}));
            if (face_type == CellType::quad9) {
                EXPECT_EQ(q[8], mean(q, std::vector<int>{0, 1, 2, 3}));
            }
        }
    }
}

TEST_F(MedTest, FacetsOfShells) {
    Mesh mesh;
    for (std::size_t i = 0; i < 4; ++i) mesh.add_node(Vec3(unit_square.data() + 3 * i), static_cast<Index>(i) + 1);
    mesh.add_cell(CellType::quad, std::array<Index, 4>{0, 1, 2, 3}, 10);
    const std::vector<GroupMembers> members = {{GroupKind::facet, {10}, {1}},
                                               {GroupKind::facet, {10}, {2}},
                                               {GroupKind::facet, {10}, {4}},
                                               {GroupKind::element, {10}, {}},
                                               {GroupKind::facet, {}, {}}};
    mesh.add_group("BELOW", GroupKind::facet);
    mesh.add_group("PLATE", GroupKind::facet);
    mesh.add_group("EDGE", GroupKind::facet);
    mesh.add_group("PLATE", GroupKind::element);
    mesh.add_group("NOTHING", GroupKind::facet);
    assign_groups(mesh, members);
    write_med(mesh, path_);
    const Mesh back = read_med(path_);
    const Members expected = {{{GroupKind::element, "BELOW"}, {11}},
                              {{GroupKind::element, "PLATE_SURF"}, {12}},
                              {{GroupKind::element, "EDGE"}, {13}},
                              {{GroupKind::element, "PLATE"}, {10}},
                              {{GroupKind::element, "NOTHING"}, {}}};
    EXPECT_EQ(members_of(back), expected);
    EXPECT_THAT(back.block(CellType::quad).ids, ElementsAre(10, 11, 12));
    EXPECT_EQ(vector_area(back, CellType::quad, 1), Vec3(0, 0, -1));
    EXPECT_EQ(vector_area(back, CellType::quad, 2), Vec3(0, 0, 1));
    EXPECT_THAT(back.block(CellType::line).connectivity, ElementsAre(1, 2));
}

// --- Bad files and bad targets -------------------------------------------------------------------------

TEST_F(MedTest, NotAMedFile) {
    expect_error<ReadError>([&] { read_med(path_); }, "no such file");
    expect_error<ReadError>([&] { read_med(directory_); }, "not a file");
    std::ofstream(path_) << "*NODE\n1, 0, 0, 0\n";
    expect_error<ReadError>([&] { read_med(path_); }, "not a MED file");
    std::ofstream(path_, std::ios::trunc).flush();
    expect_error<ReadError>([&] { read_med(path_); }, "not a MED file");
}

TEST_F(MedTest, DamagedFilesAreRefusedOrValid) {
    std::mt19937 random(1234);
    write_med(random_mesh(random, 4), path_);
    std::ifstream in(path_, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    const fs::path damaged = directory_ / "damaged.med";
    int refused = 0;
    constexpr int count = 500;
    for (int k = 0; k < count; ++k) {
        std::string bytes = whole;
        // Half of the flips hit the first bytes, where most of the structure is.
        if (k % 4 == 0)
            bytes.resize(random() % whole.size());
        else
            for (unsigned n = k % 4 == 1 ? 1 : 1 + random() % 8; n > 0; --n)
                bytes[random() % (k % 2 ? whole.size() : 8192)] ^= static_cast<char>(1 + random() % 255);
        std::ofstream(damaged, std::ios::binary | std::ios::trunc) << bytes;
        try {
            read_med(damaged).validate();
        } catch (const ReadError& e) {
            ++refused;
            EXPECT_THAT(e.what(), HasSubstr("damaged.med: "));
        } catch (const UnsupportedElementError&) {
            ++refused;
        }
    }
    RecordProperty("refused", refused);
    EXPECT_GT(refused, count / 4);
    EXPECT_LT(refused, count);
    // Nothing of the damaged files lingers: the same path, whole again, reads.
    std::ofstream(damaged, std::ios::binary | std::ios::trunc) << whole;
    expect_same(read_med(path_), read_med(damaged));
}

TEST_F(MedTest, EveryTruncationIsRefused) {
    std::mt19937 random(7);
    write_med(random_mesh(random), path_);
    const auto size = fs::file_size(path_);
    for (const double part : {0.999, 0.9, 0.5, 0.1, 0.01, 0.001}) {
        fs::resize_file(path_, static_cast<std::uintmax_t>(part * static_cast<double>(size)));
        EXPECT_THROW(read_med(path_), ReadError) << part;
    }
}

TEST_F(MedTest, UnwritableIsNamedAndLeavesTheOldFile) {
    Mesh mesh;
    mesh.add_node({1, 2, 3}, 1);
    write_med(mesh, path_);
    expect_error<WriteError>([&] { write_med(mesh, directory_ / "none" / "m.med"); }, "no directory");
    mesh.add_group(std::string(81, 'x'), GroupKind::node);
    expect_error<WriteError>([&] { write_med(mesh, path_); }, "has 81 bytes");
    mesh.groups[0].name = "blank ";
    expect_error<WriteError>([&] { write_med(mesh, path_); }, "ends in a blank");
    mesh.groups.clear();
    mesh.unit = "micrometre (1e-6 m)";
    expect_error<WriteError>([&] { write_med(mesh, path_); }, "the unit 'micrometre (1e-6 m)' has 19 bytes");
    mesh.unit = "sixteen bytes ok";
    write_med(mesh, path_);
    EXPECT_EQ(read_med(path_).unit, mesh.unit);
    mesh.node_ids[0] = Index{1} << 40;
    if (sizeof(med_int) < sizeof(Index))
        expect_error<WriteError>([&] { write_med(mesh, path_); }, "1099511627776 is larger than");
    expect_error<WriteError>([&] { write_med(Mesh(), path_); }, "needs nodes");
    EXPECT_EQ(read_med(path_).points[0], Vec3(1, 2, 3));
    EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator{}), 1);
}

TEST_F(MedTest, AwkwardMeshNames) {
    Mesh mesh;
    mesh.add_node({1, 2, 3}, 1);
    const std::pair<std::string, std::string> names[] = {
        {"a/b", "a_b"}, {"", "mesh"}, {"end  ", "end"}, {std::string(63, 'x') + "\u00e9", std::string(63, 'x')}};
    for (const auto& [name, written] : names) {
        mesh.name = name;
        write_med(mesh, path_);
        EXPECT_EQ(read_med(path_).name, written);
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
