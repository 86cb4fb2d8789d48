// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/locate.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::IsEmpty;

const Plane plane({1, 0, 0}, {1, 0, 0});

/// Two cubes; LEFT is the first.
Mesh two_cubes() {
    Mesh mesh = checks::grid(2, 1, 1);  // nodes 10 to 21, elements 100 to 111
    const FamilyIndex left = checks::family_of(mesh, "LEFT", GroupKind::element);
    for (Index c = 0; c < 6; ++c) mesh.block(CellType::tetra).families[c] = left;
    return mesh;
}

TEST(Edit, PutsTheBandBackAndMakesTheGroups) {
    const Mesh mesh = two_cubes();
    Edit edit(mesh, {});
    EXPECT_EQ(&edit.mesh(), &mesh) << "without a deck there is nothing to mark";
    EXPECT_EQ(edit.numbering().node, 22);
    EXPECT_EQ(edit.numbering().cell, 112);
    EXPECT_FALSE(edit.is_part());
    edit.start_copy();
    Workpiece f = checks::whole_workpiece(edit.mesh(), plane);
    const Opening opening = open_lips(f);
    Laps laps;
    Stopwatch watch(laps);
    const Edited edited = edit.finish(f, opening, {.groups = {{"N", "BOTH"}, {"P", "BOTH"}}, .front = "FRONT"}, watch);
    const Mesh& after = edited.rebuilt.mesh;
    after.validate();
    EXPECT_EQ(edited.rebuilt.nodes_doubled, 4);
    EXPECT_EQ(checks::members(after, "N", GroupKind::element).size(), 2u);
    EXPECT_EQ(checks::members(after, "BOTH", GroupKind::element).size(), 4u);
    EXPECT_FALSE(after.find_group("FRONT")) << "all came apart";
    EXPECT_TRUE(edited.deck.empty());
    EXPECT_EQ(laps.list().front().first, "rebuild");
    // The measures are those of the whole mesh, before and after.
    const FamilyTotals before = family_totals(mesh), now = family_totals(after);
    ASSERT_EQ(edited.before.by_family.size(), before.by_family.size());
    ASSERT_EQ(edited.after.by_family.size(), now.by_family.size());
    for (std::size_t k = 0; k < now.by_family.size(); ++k) {
        EXPECT_EQ(edited.after.by_family[k].nodes, now.by_family[k].nodes);
        EXPECT_EQ(edited.after.by_family[k].cells, now.by_family[k].cells);
        if (k > 0) {
            EXPECT_NEAR(edited.after.by_family[k].measure[3], now.by_family[k].measure[3], 1e-14);
        }
    }
}

TEST(Edit, NamesAFrontOfNodes) {
    const Mesh mesh = checks::grid(2, 2, 1);
    Edit edit(mesh, {});
    edit.start_copy();
    Workpiece f = checks::whole_workpiece(edit.mesh(), plane);
    Opening opening = open_lips(f);
    opening.front_nodes = {checks::node_at(f.d.band, {0, 0, 0})};
    Laps laps;
    Stopwatch watch(laps);
    const Edited edited = edit.finish(f, opening, {.groups = {{"N"}, {"P"}}, .front = "FRONT"}, watch);
    EXPECT_THAT(checks::members(edited.rebuilt.mesh, "FRONT", GroupKind::node), ElementsAre(10));
}

TEST(Edit, GoesOnWithTheBandAlone) {
    const Mesh mesh = checks::grid(12, 1, 1);
    const Plane there({3.5, 0, 0}, {1, 0, 0});
    DeckMarks marks;
    marks.pinned = {1, 7, 51};  // x = 1, 7 and 12
    marks.related = {7};
    Edit edit(mesh, {.marks = &marks});
    edit.start_copy(false);
    const Blade blade{.tool = &there, .bound = {}, .inside = {}};
    Location location = locate(mesh, {&blade, 1}, 2);
    std::vector<CellRef> removed{{CellType::tetra, 70}};
    edit.keep_band(location, removed);
    EXPECT_TRUE(edit.is_part());
    EXPECT_EQ(&edit.whole(), &mesh);
    EXPECT_EQ(edit.mesh().cell_count(), 7 * 6 + 1) << "from x = 0 to 7, and what is to be removed";
    EXPECT_THAT(removed, ElementsAre(CellRef{CellType::tetra, 42}));
    EXPECT_EQ(edit.mesh().block(CellType::tetra).ids[42], mesh.block(CellType::tetra).ids[70]);
    ASSERT_EQ(static_cast<Index>(location.distance.size()), edit.mesh().node_count());
    ASSERT_EQ(location.level.size(), location.distance.size());
    for (Index n = 0; n < edit.mesh().node_count(); ++n) {
        EXPECT_EQ(location.distance[n], edit.mesh().points[n].x() - 3.5);
        EXPECT_EQ(location.level[n] >= 0, std::abs(location.distance[n]) < 3);
    }
    EXPECT_EQ(edit.adjacency(), nullptr);
    // Pinned nodes by their places in the part; the one at x = 12 is the removed element's, or not there.
    std::vector<double> pinned;
    for (const Index n : edit.constraints().pinned) pinned.push_back(edit.mesh().points[n].x());
    EXPECT_THAT(pinned, testing::AllOf(testing::Contains(1), testing::Contains(7)));
    ASSERT_EQ(edit.constraints().related.size(), 1u);
    EXPECT_EQ(edit.mesh().points[edit.constraints().related[0]].x(), 7);
    EXPECT_EQ(edit.numbering().node, 10 + 52) << "new numbers are new in the whole mesh";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
