// SPDX-License-Identifier: LGPL-2.1-or-later
#include "format_testing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "deck/edge_beams.h"

namespace femscalpel::checks {

Mesh one_of_each(std::initializer_list<CellType> without) {
    Mesh mesh;
    for (Index i = 0; i < 29; ++i) {
        const auto x = static_cast<double>(i);
        mesh.add_node({x / 3, -x * x * 1e-7, 1e10 / (x + 1)}, 1000 - 7 * i);
    }
    std::vector<Index> nodes(27);
    std::iota(nodes.begin(), nodes.end(), 1);
    std::ranges::reverse(nodes);
    std::vector<Index> numbers;
    for (const CellTraits& t : all_cell_types()) {
        if (std::ranges::count(without, t.type)) continue;
        numbers.push_back(500 - 3 * static_cast<Index>(t.type));
        mesh.add_cell(t.type, std::span(nodes).first(static_cast<std::size_t>(t.nodes)), numbers.back());
    }
    std::vector<GroupMembers> members;
    const auto group = [&](const char* name, GroupKind kind, std::vector<Index> ids) {
        mesh.add_group(name, kind);
        members.push_back({kind, std::move(ids), {}});
    };
    group("Träger A 1", GroupKind::element, {numbers.begin(), numbers.begin() + 5});
    group("second", GroupKind::element, {numbers.begin() + 3, numbers.end()});
    group("FIX", GroupKind::node, {1000, 993, 804});  // no element has the first and the last
    group("nothing", GroupKind::element, {});
    group("FIX", GroupKind::element, {numbers.back()});
    group("overlaps FIX", GroupKind::node, {993, 986});
    group("no nodes", GroupKind::node, {});
    assign_groups(mesh, members);
    return mesh;
}

void expect_equal(const Mesh& found, const Mesh& expected) {
    EXPECT_EQ(found.points, expected.points);
    EXPECT_EQ(found.node_ids, expected.node_ids);
    for (const CellBlock& block : expected.blocks()) {
        const CellBlock& other = found.block(block.type);
        EXPECT_EQ(other.ids, block.ids) << traits(block.type).name;
        EXPECT_EQ(other.connectivity, block.connectivity) << traits(block.type).name;
    }
    // What segments are is known of some formats.
    const auto counted = [](const Mesh& mesh) {
        std::vector<GroupIndex> out;
        for (std::size_t g = 0; g < mesh.groups.size(); ++g)
            if (!mesh.groups[g].hidden || mesh.groups[g].name != edge_beams_group)
                out.push_back(static_cast<GroupIndex>(g));
        return out;
    };
    const std::vector<GroupIndex> of_found = counted(found), of_expected = counted(expected);
    ASSERT_EQ(of_found.size(), of_expected.size());
    for (std::size_t k = 0; k < of_expected.size(); ++k) {
        const auto g = static_cast<std::size_t>(of_expected[k]), other = static_cast<std::size_t>(of_found[k]);
        EXPECT_EQ(found.groups[other].name, expected.groups[g].name);
        EXPECT_EQ(found.groups[other].kind, expected.groups[g].kind) << expected.groups[g].name;
        const GroupMembers members = group_members(found, of_found[k]),
                           wanted = group_members(expected, of_expected[k]);
        EXPECT_EQ(members.ids, wanted.ids) << expected.groups[g].name;
        EXPECT_EQ(members.faces, wanted.faces) << expected.groups[g].name;
    }
    EXPECT_NO_THROW(found.validate());
}

}  // namespace femscalpel::checks
