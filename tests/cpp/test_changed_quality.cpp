// SPDX-License-Identifier: LGPL-2.1-or-later
// Which elements the quality in a report is of.
#include "operators/changed_quality.h"

#include <gtest/gtest.h>

#include "operators/edit.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(ChangedQuality, OfWhatWasDividedAndItsParts) {
    Mesh mesh = checks::grid(2, 2, 2);
    const Mesh input = mesh;
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    f.split_edge(checks::node_at(f.d.band, {0, 0, 0}), checks::node_at(f.d.band, {1, 0, 0}), Vec3(0.5, 0, 0), {});
    const Rebuilt rebuilt = rebuild(mesh, input, f, no_opening(f.d.band), {}, next_numbers(mesh));
    Report report;
    describe_changed(mesh, f, rebuilt, report);
    EXPECT_EQ(report.quality_before.count, static_cast<Index>(rebuilt.before.size()));
    EXPECT_GT(report.quality_before.count, 0);
    EXPECT_EQ(report.quality_after.count, 2 * report.quality_before.count);
    EXPECT_LT(report.quality_after.minimum, report.quality_before.minimum);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
