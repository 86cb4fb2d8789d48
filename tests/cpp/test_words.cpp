// SPDX-License-Identifier: LGPL-2.1-or-later
#include "words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "groups/nearest_group.h"
#include "groups/unknown_group.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Words, OneIsNoPlural) {
    EXPECT_EQ(counted(1, "node"), "1 node");
    EXPECT_EQ(counted(0, "node"), "0 nodes");
    EXPECT_EQ(counted(2, "node"), "2 nodes");
    EXPECT_EQ(counted(1, "edge stays", "edges stay"), "1 edge stays");
    EXPECT_EQ(counted(3, "edge stays", "edges stay"), "3 edges stay");
}

TEST(Words, SimilarNames) {
    const std::vector<std::string> names{"TOP", "BOTTOM", "LEFT_WALL", "Right", "HOLE_WALL", "TOP"};
    EXPECT_THAT(similar_names("TPO", names), ElementsAre("TOP"));
    EXPECT_THAT(similar_names("top", names), ElementsAre("TOP"));
    EXPECT_THAT(similar_names("BOTOM", names), ElementsAre("BOTTOM"));
    EXPECT_THAT(similar_names("WALL", names), ElementsAre("HOLE_WALL", "LEFT_WALL"));
    EXPECT_THAT(similar_names("RIGHT", names), ElementsAre("Right"));
    EXPECT_THAT(similar_names("SUPPORT", names), IsEmpty());
    EXPECT_THAT(similar_names("", names), IsEmpty());
    EXPECT_EQ(did_you_mean("WALL", names), " Did you mean 'HOLE_WALL' or 'LEFT_WALL'?");
    EXPECT_EQ(did_you_mean("SUPPORT", names), "");
}

TEST(Words, AGroupThatIsNotThere) {
    Mesh mesh = checks::grid(1, 1, 1);
    EXPECT_EQ(no_group_text(mesh, "TOP"), "the mesh has no group 'TOP', nor any other");
    mesh.add_group("TOP", GroupKind::node);
    mesh.add_group("TOP", GroupKind::element);
    mesh.add_group("BOTTOM", GroupKind::node);
    EXPECT_EQ(no_group_text(mesh, "TPO"), "the mesh has no group 'TPO'. Did you mean 'TOP'?");
    EXPECT_EQ(no_group_text(mesh, "LOAD"), "the mesh has no group 'LOAD'; it has 'TOP', 'BOTTOM'");
}

TEST(Words, TheGroupNearestToAPlace) {
    Mesh mesh = checks::grid(4, 1, 1);
    EXPECT_EQ(nearest_group(mesh, {4, 0, 0}).name, "");
    const FamilyIndex all = checks::family_of(mesh, "ALL", GroupKind::node);
    const GroupIndex end = mesh.add_group("END", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        mesh.node_families[n] = mesh.points[n].x() == 4 ? mesh.families.with(all, end) : all;
    EXPECT_EQ(nearest_group(mesh, {5, 0.5, 0}).name, "END");  // both are as near, but it says more
    EXPECT_EQ(nearest_group(mesh, {4, 0, 3}).name, "END");
    EXPECT_EQ(nearest_group(mesh, {4, 0, 3}).distance, 2);
    EXPECT_EQ(nearest_group(mesh, {0, 0, 0}).name, "ALL");
    EXPECT_EQ(nearest_group(mesh, {4, 0, 0}, "END").name, "ALL");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
