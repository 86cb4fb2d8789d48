// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/opening_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace {

using testing::ElementsAre;

TEST(OpeningGroups, AreOfNodesWhereOnlyBeamsEnd) {
    Mesh mesh;
    mesh.add_group("OLD", GroupKind::node);
    Opening opening;
    opening.faces.push_back({{0, 1, 2}, 0, Opening::fresh, false});
    opening.ends = {{5, 0}, {6, 1}};
    const auto groups = add_opening_groups(mesh, opening, {{"WALL", "WALL1"}, {"WALL", "WALL2"}, {"BOTTOM"}});
    EXPECT_THAT(groups, ElementsAre(ElementsAre(1, 2), ElementsAre(1, 3), ElementsAre(4)));
    const auto kind = [&](GroupIndex g) { return mesh.groups[static_cast<std::size_t>(g)].kind; };
    EXPECT_EQ(kind(1), GroupKind::element) << "faces have it, too";
    EXPECT_EQ(kind(2), GroupKind::element);
    EXPECT_EQ(kind(3), GroupKind::node);
    EXPECT_EQ(kind(4), GroupKind::element) << "of nothing";
}

}  // namespace
}  // namespace femscalpel
