// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/group_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "format_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(GroupNumbers, AreThoseOfEachGroupInTheOrderOfTheMesh) {
    const Mesh mesh = checks::one_of_each({});
    const std::vector<std::vector<Index>> numbers = group_numbers(mesh);
    ASSERT_EQ(numbers.size(), mesh.groups.size());
    std::vector<std::vector<Index>> expected(mesh.groups.size());
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        const auto holds = [&](FamilyIndex family) {
            const auto& groups = mesh.families.groups(family);
            return std::ranges::find(groups, static_cast<GroupIndex>(g)) != groups.end();
        };
        if (mesh.groups[g].kind == GroupKind::node) {
            for (std::size_t n = 0; n < mesh.points.size(); ++n)
                if (holds(mesh.node_families[n])) expected[g].push_back(mesh.node_ids[n]);
        } else {
            for (const CellBlock& block : mesh.blocks())
                for (std::size_t c = 0; c < block.ids.size(); ++c)
                    if (holds(block.families[c])) expected[g].push_back(block.ids[c]);
        }
    }
    EXPECT_EQ(numbers, expected);
    EXPECT_GT(std::ranges::count_if(numbers, [](const auto& n) { return n.size() > 1; }), 1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
