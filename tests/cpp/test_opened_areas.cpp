// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/opened_areas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "simple_meshes.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A tetrahedron, number 7, with segments on some of its edges in the group RING.
struct OpenedAreas : testing::Test {
    OpenedAreas() {
        for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
            mesh.add_node(at, mesh.node_count() + 1);
        mesh.add_cell(CellType::tetra, std::array<Index, 4>{0, 1, 2, 3}, 7);
        ring = checks::family_of(mesh, "RING", GroupKind::element);
    }
    void add_segments(const std::vector<std::array<Index, 2>>& edges) {
        for (const auto& e : edges) mesh.add_cell(CellType::line, e, mesh.largest_cell_id() + 1, ring);
    }
    std::vector<std::string> warnings(bool split, int a = 0, int b = 1) const {
        BandMesh band = extract_band(mesh, {0, 0, 0, 0});
        if (split) band.split_edge(a, b, (band.nodes[a].at + band.nodes[b].at) / 2);
        return warnings_of_opened_areas(band, mesh);
    }
    Mesh mesh;
    FamilyIndex ring = 0;
};

TEST_F(OpenedAreas, AreFacesWithinSegmentsThatWereSplit) {
    add_segments({{0, 1}, {1, 2}, {2, 0}});
    EXPECT_THAT(warnings(false), IsEmpty());
    EXPECT_THAT(warnings(true), ElementsAre(HasSubstr("group 'RING' covers element 7, or faces of them, only by the "
                                                      "edges or faces around")));
    EXPECT_THAT(warnings(true, 1, 3), IsEmpty()) << "an edge of another face";
}

TEST_F(OpenedAreas, AreNoneWhereAnEdgeIsMissing) {
    add_segments({{0, 1}, {1, 2}});
    EXPECT_THAT(warnings(true), IsEmpty());
}

TEST_F(OpenedAreas, AreNoneWhereAnElementOfTheGroupIsThere) {
    add_segments({{0, 1}, {1, 2}, {2, 0}});
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 2, 1}, 50, ring);
    EXPECT_THAT(warnings(true), IsEmpty());
}

TEST_F(OpenedAreas, AreTheInsideOfAnElementWithAllFacesInTheGroup) {
    for (const auto& face : {std::array<Index, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
        mesh.add_cell(CellType::triangle, face, mesh.largest_cell_id() + 1, ring);
    EXPECT_THAT(warnings(true), ElementsAre(HasSubstr("covers element 7")));
    mesh.block(CellType::tetra).families[0] = ring;
    EXPECT_THAT(warnings(true), IsEmpty());
}

TEST_F(OpenedAreas, OfHiddenGroupsAreNotTold) {
    mesh.groups[0].hidden = true;
    add_segments({{0, 1}, {1, 2}, {2, 0}});
    EXPECT_THAT(warnings(true), IsEmpty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
