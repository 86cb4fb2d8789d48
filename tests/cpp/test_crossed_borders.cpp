// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/crossed_borders.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

CellLists all_tetras(const Mesh& mesh) {
    CellLists out;
    for (Index c = 0; c < mesh.block(CellType::tetra).size(); ++c) out[static_cast<int>(CellType::tetra)].push_back(c);
    return out;
}

/// With a cube of that size for the other, where faces at y = `kept` stay.
CrossedBorders crossed(const Mesh& mesh, const CellLists& taken, const Vec3& origin, double size, double kept = -1) {
    Mesh cube = checks::grid(1, 1, 1);
    for (Vec3& x : cube.points) x = origin + size * x;
    return crossed_borders(mesh, taken, cube, [&](const std::array<Index, 3>& face) {
        return std::ranges::all_of(face, [&](Index n) { return mesh.points[n].y() <= kept; });
    });
}

TEST(CrossedBorders, AreThoseOutsideOfTheOther) {
    const Mesh halves = checks::two_halves();
    const CrossedBorders found = crossed(halves, all_tetras(halves), {5, 5, 5}, 1);
    EXPECT_EQ(found.groups, (std::set<GroupIndex>{0, 1}));
    EXPECT_DOUBLE_EQ(found.at.x(), 1);
    EXPECT_EQ(found.lost, 0);
    EXPECT_TRUE(crossed(halves, all_tetras(halves), {-1, -1, -1}, 5).groups.empty());
}

TEST(CrossedBorders, AreNoneWhereOneSideStays) {
    const Mesh halves = checks::two_halves();
    CellLists left;
    const CellBlock& b = halves.block(CellType::tetra);
    for (Index c = 0; c < b.size(); ++c)
        if (halves.families.contains(b.families[c], 0)) left[static_cast<int>(CellType::tetra)].push_back(c);
    EXPECT_TRUE(crossed(halves, left, {5, 5, 5}, 1).groups.empty());
}

TEST(CrossedBorders, TheirFacesAreCounted) {
    Mesh halves = checks::two_halves();
    checks::add_plate(halves, {1, 0, 0}, Vec3::UnitY(), Vec3::UnitZ(), 2, 2,
                      checks::family_of(halves, "MIDDLE", GroupKind::element));
    const CrossedBorders found = crossed(halves, all_tetras(halves), {5, 5, 5}, 1);
    EXPECT_EQ(found.lost, 8);
    EXPECT_EQ(crossed(halves, all_tetras(halves), {5, 5, 5}, 1, 1).lost, 4);
    EXPECT_EQ(found.faces, (std::set<GroupIndex>{*halves.find_group("MIDDLE", GroupKind::element)}));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
