// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/weld_springs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;

/// Springs 3 and 4, from 1 to 11 and from 2 to 12; what was aside of it is out of `mesh`, which has further nodes.
struct Sprung {
    Mesh input, mesh;
    Welded welded;

    Sprung() {
        for (const Index number : {1, 2, 11, 12}) input.add_node(Vec3::Zero(), number);
        input.add_cell(CellType::line, std::array<Index, 2>{0, 2}, 3);
        input.add_cell(CellType::line, std::array<Index, 2>{1, 3}, 4);
        const GroupIndex group = input.add_group("SPRINGS", GroupKind::element);
        set_group_members(input, group, {GroupKind::element, {3, 4}, {}});
        mesh = input;
        mesh.block(CellType::line) = CellBlock{CellType::line, {}, {}, {}};
        for (const Index number : {20, 21}) mesh.add_node(Vec3::Zero(), number);
        welded.aside = {{CellType::line, 0}, {CellType::line, 1}};
    }
};

TEST(WeldSprings, ANewPairGetsWhatAllThatItComesFromHave) {
    Sprung s;
    Changes changes;
    // The other way round, as facing nodes come.
    const WeldSprings out = put_back_springs(s.input, s.welded, {{21, 20, {2, 3}, {0, 1}}}, s.mesh, changes, 50);
    const CellBlock& lines = s.mesh.block(CellType::line);
    EXPECT_THAT(lines.ids, ElementsAre(3, 4, 50));
    EXPECT_THAT(lines.connectivity, ElementsAre(0, 2, 1, 3, 4, 5));
    EXPECT_THAT(group_members(s.mesh, 0).ids, ElementsAre(3, 4, 50));
    EXPECT_THAT(out.made, ElementsAre(CellRef{CellType::line, 2}));
    EXPECT_TRUE(out.removed.empty());
    ASSERT_EQ(changes.parts.size(), 1u);
    EXPECT_EQ(changes.parts[0].parent, 3);
}

TEST(WeldSprings, NotWhereOneHasNone) {
    Sprung s;
    s.welded.aside.pop_back();
    Changes changes;
    put_back_springs(s.input, s.welded, {{20, 21, {0, 1}, {2, 3}}}, s.mesh, changes, 50);
    EXPECT_THAT(s.mesh.block(CellType::line).ids, ElementsAre(3));
}

TEST(WeldSprings, WhatLostANodeGoes) {
    Sprung s;
    s.mesh.node_ids[2] = 99;
    Changes changes;
    const WeldSprings out = put_back_springs(s.input, s.welded, {}, s.mesh, changes, 50);
    EXPECT_THAT(s.mesh.block(CellType::line).ids, ElementsAre(4));
    EXPECT_THAT(out.removed, ElementsAre(CellRef{CellType::line, 0}));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
