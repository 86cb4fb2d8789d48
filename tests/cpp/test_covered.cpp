// SPDX-License-Identifier: LGPL-2.1-or-later
// What a group covers, by the kind of its members.
#include "groups/covered.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::HasSubstr;

GroupIndex nodes_at_top(Mesh& mesh, double z) {
    const FamilyIndex family = checks::family_of(mesh, "TOP", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (mesh.points[n].z() == z) mesh.node_families[n] = family;
    return *mesh.find_group("TOP");
}

std::string refusal(const Mesh& mesh, GroupIndex group) {
    try {
        covered_by(mesh, group);
    } catch (const ToolError& e) {
        EXPECT_STREQ(e.parameter(), "group");
        return e.what();
    }
    return "";
}

TEST(Covered, NodesStandForFacesOfTheSkin) {
    Mesh mesh = checks::grid(2, 3, 2);
    const Covered out = covered_by(mesh, nodes_at_top(mesh, 2));
    EXPECT_TRUE(out.faces);
    EXPECT_EQ(out.parts.size(), 2U * 2 * 3);
    for (const auto& part : out.parts) {
        EXPECT_TRUE(part[0] < part[1] && part[1] < part[2]);
        for (const Index n : part) EXPECT_EQ(mesh.points[n].z(), 2);
    }
}

TEST(Covered, NodesInsideCoverNothing) {
    Mesh mesh = checks::grid(2, 3, 2);
    EXPECT_THAT(refusal(mesh, nodes_at_top(mesh, 1)), HasSubstr("covers no face"));
    EXPECT_THAT(refusal(mesh, mesh.add_group("NONE", GroupKind::node)), HasSubstr("is empty"));
}

TEST(Covered, TrianglesAndFacets) {
    Mesh mesh = checks::grid(1, 1, 1);
    const FamilyIndex facet = checks::family_of(mesh, "FACET", GroupKind::facet);
    mesh.facets.push_back({CellType::tetra, 1, facet, 0});
    const auto n = mesh.block(CellType::tetra).nodes(0);
    std::array<Index, 3> face{n[0], n[1], n[2]};
    mesh.add_cell(CellType::triangle, face, 100, checks::family_of(mesh, "FACE", GroupKind::element));
    std::ranges::sort(face);
    EXPECT_THAT(covered_by(mesh, *mesh.find_group("FACET")).parts, testing::ElementsAre(face));
    EXPECT_THAT(covered_by(mesh, *mesh.find_group("FACE")).parts, testing::ElementsAre(face));
}

TEST(Covered, VolumesAreRefused) {
    Mesh mesh = checks::two_halves();
    EXPECT_THAT(refusal(mesh, *mesh.find_group("LEFT")), HasSubstr("has tetra"));
}

TEST(Covered, EdgesOfShells) {
    Mesh mesh;
    checks::add_plate(mesh, Vec3::Zero(), {3, 0, 0}, {0, 2, 0}, 3, 2);
    const FamilyIndex family = checks::family_of(mesh, "SIDE", GroupKind::node);
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
        if (mesh.points[k].x() == 0) mesh.node_families[k] = family;
    const Covered out = covered_by(mesh, *mesh.find_group("SIDE"));
    EXPECT_FALSE(out.faces);
    ASSERT_FALSE(out.parts.empty());
    for (const auto& part : out.parts) EXPECT_EQ(part[2], -1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
