// SPDX-License-Identifier: LGPL-2.1-or-later
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "format_testing.h"
#include "io/msh_builder.h"
#include "io/msh_groups.h"
#include "io/msh_sections.h"
#include "io/msh_source.h"
#include "io/msh_types.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class MshParts : public testing::Test {
protected:
    void TearDown() override { fs::remove(path_); }
    MshSource source(const std::string& text) const {
        std::ofstream(path_, std::ios::binary | std::ios::trunc) << text;
        return MshSource(path_);
    }
    const fs::path path_ =
        fs::path(testing::TempDir()) / ("femscalpel_" + std::to_string(::getpid()) + "_" +
                                        testing::UnitTest::GetInstance()->current_test_info()->name() + ".msh");
};

TEST_F(MshParts, TypesAndTheirOtherSides) {
    for (const CellTraits& t : all_cell_types()) {
        const MshType& type = msh_type(t.type);
        if (t.type == CellType::triangle7) {
            EXPECT_EQ(type.number, 0);
            continue;
        }
        EXPECT_EQ(cell_type_of_msh(type.number), t.type);
        EXPECT_EQ(msh_type_description(type.number), "");
        std::vector<int> seen(type.order.begin(), type.order.begin() + t.nodes);
        std::ranges::sort(seen);
        for (int k = 0; k < t.nodes; ++k) EXPECT_EQ(seen[static_cast<std::size_t>(k)], k) << t.name;
        if (t.dimension != 1 && t.dimension != 2) continue;
        const auto from = turned_round(t.type);
        EXPECT_NE(from[1], 1);
        for (std::size_t k = 0; k < static_cast<std::size_t>(t.nodes); ++k)
            EXPECT_EQ(static_cast<std::size_t>(from[from[k]]), k) << t.name;
        if (!t.quadratic || t.dimension == 1) continue;
        const auto ends = [](int a, int b) { return std::minmax({a, b}); };
        for (std::size_t e = 0; e < t.edges.size(); ++e) {  // middles stay between the ends of their edges
            const auto& old =
                t.edges[from[static_cast<std::size_t>(t.corners) + e] - static_cast<std::size_t>(t.corners)];
            const auto& now = t.edges[e];
            EXPECT_EQ(ends(old[0], old[1]),
                      ends(from[static_cast<std::size_t>(now[0])], from[static_cast<std::size_t>(now[1])]))
                << t.name;
        }
    }
    EXPECT_FALSE(cell_type_of_msh(0));
    EXPECT_FALSE(cell_type_of_msh(14));
    EXPECT_EQ(msh_type_description(14), "14-node second order pyramid");
}

TEST_F(MshParts, SourceOfTextAndBinary) {
    checks::Bytes bytes;
    bytes.text("$MeshFormat\n4.1 1 8\n$EndMeshFormat\n");  // says that what follows are bytes
    bytes.text("$A\nx +5 -1e-400 1.5\n$EndA\n$B\n").put<std::int32_t>({-7}).put<std::int64_t>({8}).put<double>({0.1});
    bytes.text("\n$EndB\n");
    MshSource s = source(bytes.str());
    EXPECT_EQ(s.next_section(), "MeshFormat");
    s.skip_section();
    EXPECT_EQ(s.next_section(), "A");
    EXPECT_EQ(s.word(), "x");
    EXPECT_EQ(s.text_integer(), 5);
    EXPECT_EQ(s.real(), 0);
    EXPECT_EQ(s.real(), 1.5);
    EXPECT_EQ(s.where(), path_.string() + ":5: ");
    s.end_section();
    s.set_binary(false);
    EXPECT_EQ(s.next_section(), "B");
    EXPECT_EQ(s.section_line(), 7);
    EXPECT_EQ(s.integer(), -7);
    EXPECT_THAT([&] { s.expect(100, 4); }, ThrowsMessage<Error>(HasSubstr("$B, byte 64: the number 100 is more")));
    EXPECT_THAT([&] { s.expect(-2, 4); }, ThrowsMessage<Error>(HasSubstr("the number -2 is no count")));
    EXPECT_EQ(s.size(), 8);
    EXPECT_EQ(s.real(), 0.1);
    s.end_section();
    EXPECT_EQ(s.next_section(), "");
    s.rewind_to_sections();
    EXPECT_TRUE(s.find_section("B"));
    EXPECT_FALSE(s.find_section("C"));
    s.skip_section();
    EXPECT_EQ(s.next_section(), "");
}

TEST_F(MshParts, GroupsOfNamesAndTags) {
    Mesh mesh;
    MshGroups groups(mesh);
    EXPECT_TRUE(groups.name(2, 1, "A"));
    EXPECT_TRUE(groups.name(2, 1, "A"));
    EXPECT_FALSE(groups.name(2, 1, "B"));
    groups.name(3, 5, "A");
    groups.name(0, 2, "P");
    groups.name(0, 3, "Q");
    groups.set_node_groups({2});
    groups.make_named();
    ASSERT_EQ(mesh.groups.size(), 3u);
    EXPECT_EQ(mesh.groups[1].kind, GroupKind::node);
    EXPECT_EQ(mesh.groups[2].kind, GroupKind::element);
    EXPECT_FALSE(groups.any());
    const std::array<Index, 3> tags = {-1, 8, 0}, points = {2, 3, 0};
    EXPECT_THAT(mesh.families.groups(groups.elements(2, tags)), ElementsAre(0, 3));
    EXPECT_EQ(mesh.groups[3].name, "PhysicalSurface8");
    EXPECT_THAT(mesh.families.groups(groups.nodes(points)), ElementsAre(1));
    EXPECT_THAT(mesh.families.groups(groups.elements(0, points)), ElementsAre(2));
    EXPECT_TRUE(groups.any());
}

TEST_F(MshParts, BuilderKeepsNumbersAndTurns) {
    MshSource s = source("$A\n");
    MshBuilder builder(s, {});
    builder.start_nodes(3);
    for (Index i = 0; i < 3; ++i) builder.add_node(10 + i, {static_cast<double>(i), 0, 0});
    EXPECT_THAT([&] { builder.start_elements(); },
                ThrowsMessage<Error>(HasSubstr("the elements come before the nodes")));
    builder.end_nodes();
    builder.start_elements();
    EXPECT_EQ(builder.type(2), CellType::triangle);
    EXPECT_THROW(builder.type(21), UnsupportedElementError);
    const std::array<Index, 3> nodes = {0, 1, 2};
    builder.add_element(CellType::triangle, 5, nodes, 0);
    builder.turn_last(CellType::triangle);
    const std::array<Index, 1> tags = {4};
    builder.add_to_groups(1, builder.groups().nodes(tags));
    const Mesh mesh = builder.finish();
    EXPECT_THAT(mesh.block(CellType::triangle).nodes(0), ElementsAre(0, 2, 1));
    EXPECT_THAT(checks::members(mesh, "PhysicalPoint4", GroupKind::node), ElementsAre(11));
    MshBuilder twice(s, {});
    twice.start_nodes(2);
    twice.add_node(7, {0, 0, 0});
    twice.add_node(7, {0, 0, 0});
    EXPECT_THROW(twice.end_nodes(), RepeatedNumber);
}

TEST_F(MshParts, SectionsOfBothVersions) {
    MshSource s = source("$Nodes\n1\n4 1 2 3\n$EndNodes\n$Nodes\n1 1 4 4\n2 1 0 1\n4\n1 2 3\n$EndNodes\n");
    MshBuilder old_builder(s, {}), builder(s, {});
    Msh2Sections old_sections(s, old_builder);
    Msh4Sections sections(s, builder, 1);
    EXPECT_FALSE(old_sections.read("Entities"));
    EXPECT_FALSE(sections.read("ParametricNodes"));
    EXPECT_TRUE(old_sections.read(s.next_section()));
    s.end_section();
    EXPECT_TRUE(sections.read(s.next_section()));
    s.end_section();
    for (MshBuilder* b : {&old_builder, &builder}) {
        EXPECT_THAT(b->mesh().node_ids, ElementsAre(4));
        EXPECT_EQ(b->mesh().points[0], Vec3(1, 2, 3));
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
