// SPDX-License-Identifier: LGPL-2.1-or-later
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "io/unv_source.h"
#include "io/unv_types.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

namespace fs = std::filesystem;

TEST(UnvParts, MiddlesStandBetweenTheEndsOfTheirEdges) {
    for (const CellTraits& t : all_cell_types()) {
        const UnvType& type = unv_type(t.type);
        if (type.descriptor == 0) continue;
        EXPECT_EQ(cell_type_of_unv(type.descriptor, t.nodes), t.type);
        EXPECT_FALSE(cell_type_of_unv(type.descriptor, t.nodes + 7));
        EXPECT_EQ(unv_description(type.descriptor), "");
        std::vector<int> place(static_cast<std::size_t>(t.nodes), -1);
        for (int k = 0; k < t.nodes; ++k) place[static_cast<std::size_t>(type.order[static_cast<std::size_t>(k)])] = k;
        EXPECT_EQ(std::ranges::count(place, -1), 0) << t.name;
        if (!t.quadratic) continue;
        for (std::size_t e = 0; e < t.edges.size(); ++e) {
            const int a = place[static_cast<std::size_t>(t.edges[e][0])],
                      b = place[static_cast<std::size_t>(t.edges[e][1])],
                      middle = place[static_cast<std::size_t>(t.corners) + e];
            // Behind the one end, or behind the last but one if the edge goes round, or between base and top.
            EXPECT_TRUE(middle == a + 1 || middle == b + 1 || (middle > std::min(a, b) && middle < std::max(a, b)))
                << t.name << " edge " << e;
        }
    }
    for (const int beam : {11, 21, 22, 23, 24}) EXPECT_TRUE(is_unv_beam(beam));
    EXPECT_FALSE(is_unv_beam(41));
    EXPECT_EQ(cell_type_of_unv(24, 3), CellType::line3);
    EXPECT_EQ(unv_description(122), "rigid element");
}

TEST(UnvParts, SourceFindsDataSets) {
    const fs::path path = fs::path(testing::TempDir()) / ("femscalpel_parts_" + std::to_string(::getpid()) + ".unv");
    std::ofstream(path)
        << "    -1\n    58b   1 2\n        -1\nx\n    -1\n\n    -1\n  2411\n 7 1.5D+0 a b\n c\n    -1\n";
    UnvSource source(path);
    fs::remove(path);
    ASSERT_EQ(source.datasets().size(), 2u);
    EXPECT_EQ(source.datasets()[0].number, "58b");
    EXPECT_EQ(source.datasets()[0].content, "        -1\nx\n");
    source.open(source.datasets()[1]);
    EXPECT_EQ(source.words_left(), 4);
    EXPECT_EQ(source.words_ahead(1), 1);
    EXPECT_EQ(source.words_ahead(2), 0);
    EXPECT_EQ(source.integer("a number"), 7);
    EXPECT_EQ(source.real("a number"), 1.5);
    EXPECT_EQ(source.where(), path.string() + ":9: ");
    EXPECT_EQ(source.rest_of_line(), " a b");
    EXPECT_FALSE(source.at_end());
    EXPECT_EQ(source.rest_of_line(), "c");
    EXPECT_TRUE(source.at_end());
}

TEST(UnvParts, NumbersThatFillTheirColumnsFollowEachOther) {
    const fs::path path = fs::path(testing::TempDir()) / ("femscalpel_columns_" + std::to_string(::getpid()) + ".unv");
    std::ofstream(path) << "    -1\n  2467\n"
                        << "         72147483647         0         0         81000000000         0         0\n"
                        << "214748364710000000002147483646         5\r\n"
                        << "12345678901 7\n"
                        << "         72147483x47\n    -1\n";
    UnvSource source(path);
    fs::remove(path);
    source.open(source.datasets()[0]);
    EXPECT_EQ(source.words_left(), 8);
    EXPECT_EQ(source.words_ahead(1), 4);
    for (const Index expected :
         {7L, 2147483647L, 0L, 0L, 8L, 1000000000L, 0L, 0L, 2147483647L, 1000000000L, 2147483646L, 5L})
        EXPECT_EQ(source.integer("a number"), expected);
    EXPECT_EQ(source.integer("a number"), 12345678901) << "ends within a column";
    EXPECT_EQ(source.integer("a number"), 7);
    EXPECT_THAT([&] { source.integer("a number"); }, testing::ThrowsMessage<ReadError>(testing::HasSubstr(
                                                         ":6: a number should be a whole number, not '72147483x47'")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
