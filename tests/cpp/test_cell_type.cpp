// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/cell_type.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "error.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(CellTraits, AgreeWithTheNames) {
    ASSERT_EQ(all_cell_types().size(), static_cast<std::size_t>(cell_type_count));
    std::set<std::string_view> names;
    for (const CellTraits& t : all_cell_types()) {
        EXPECT_EQ(traits(t.type).name, t.name);
        EXPECT_TRUE(names.insert(t.name).second);
        EXPECT_EQ(cell_type_from_name(t.name), t.type);
        // "tetra10" has ten nodes; names without digits are those of linear elements.
        const auto digits = t.name.find_first_of("0123456789");
        if (digits != t.name.npos) {
            EXPECT_EQ(std::to_string(t.nodes), t.name.substr(digits));
        }
        EXPECT_EQ(t.linear == t.type, t.nodes == t.corners);
        EXPECT_EQ(traits(t.linear).nodes, t.corners);
        EXPECT_EQ(traits(t.linear).dimension, t.dimension);
        EXPECT_EQ(t.simplex, t.corners == t.dimension + 1 && t.type != CellType::triangle7);
        if (t.quadratic) {
            EXPECT_GE(t.nodes, t.corners + static_cast<int>(t.edges.size()));
        }
    }
    EXPECT_THAT([] { cell_type_from_name("tetra11"); }, testing::ThrowsMessage<Error>(testing::HasSubstr("tetra11")));
}

TEST(CellTraits, OfSolidsAreClosed) {
    for (const CellTraits& t : all_cell_types()) {
        if (t.dimension < 3) {
            EXPECT_TRUE(t.faces.empty());
            continue;
        }
        // Every edge runs along two faces, once in each sense; Euler's formula holds.
        std::multiset<std::pair<int, int>> along;
        for (const auto& f : t.faces) {
            const int count = f[3] < 0 ? 3 : 4;
            for (int k = 0; k < count; ++k) along.insert({f[k], f[(k + 1) % count]});
        }
        for (const auto& e : t.edges) {
            EXPECT_EQ(along.count({e[0], e[1]}), 1u) << t.name;
            EXPECT_EQ(along.count({e[1], e[0]}), 1u) << t.name;
        }
        EXPECT_EQ(along.size(), 2 * t.edges.size()) << t.name;
        EXPECT_EQ(t.corners + static_cast<int>(t.faces.size()), static_cast<int>(t.edges.size()) + 2) << t.name;
    }
}

TEST(CellTraits, NumberTheFacesOfTetrahedraAsCalculixDoes) {
    const auto faces = traits(CellType::tetra).faces;
    const std::set<int> expected[] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}};
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(std::set<int>(faces[k].begin(), faces[k].begin() + 3), expected[k]) << "S" << k + 1;
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
