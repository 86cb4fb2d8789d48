// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::Pair;

TEST(Summarise, FindsTheWorst) {
    std::vector<ElementQuality> all;
    for (int k = 0; k < 12; ++k) all.push_back({100 - k, 0.05 * k + 0.025});
    all.push_back({7, 0.025});
    all.push_back({8, 1});
    all.push_back({9, -0.5});
    const QualitySummary s = summarise(all);
    EXPECT_EQ(s.count, 15);
    EXPECT_EQ(s.minimum, -0.5);
    EXPECT_NEAR(s.mean, (0.05 * 66 + 12 * 0.025 + 0.025 + 1 - 0.5) / 15, 1e-15);
    EXPECT_EQ(s.histogram[0], 3) << "inverted ones count with the worst";
    EXPECT_EQ(s.histogram[1], 1);
    EXPECT_EQ(s.histogram[quality_bars - 1], 1);
    ASSERT_EQ(s.worst.size(), 10u);
    EXPECT_EQ(s.worst[0].id, 9);
    EXPECT_EQ(s.worst[1].id, 7) << "of equal ones the lower number";
    EXPECT_EQ(s.worst[2].id, 100);
}

TEST(Summarise, OfNothingIsGood) {
    const QualitySummary s = summarise({});
    EXPECT_EQ(s.count, 0);
    EXPECT_EQ(s.minimum, 1);
    EXPECT_EQ(s.mean, 1);
    EXPECT_TRUE(s.worst.empty());
}

TEST(ForEachRecord, PassesOverHiddenGroups) {
    Mesh mesh;
    mesh.add_group("A", GroupKind::node);
    mesh.add_group("*CARD", GroupKind::node, true);
    mesh.add_group("B", GroupKind::node);
    Report report;
    for (const char* name : {"A", "B", "NEW"}) report.groups.emplace_back().name = name;
    std::vector<std::pair<std::size_t, std::string>> seen;
    for_each_record(mesh, report, [&](std::size_t g, const GroupRecord& r) { seen.emplace_back(g, r.name); });
    EXPECT_THAT(seen, ElementsAre(Pair(0, "A"), Pair(2, "B")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
