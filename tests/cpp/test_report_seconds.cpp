// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "io/io.h"
#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "operators/refine.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// Of the time that a call took, measured around it, the part that its report tells of.
double told(const std::function<Report()>& run) {
    const auto start = std::chrono::steady_clock::now();
    const Report report = run();
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double sum = 0;
    for (const auto& [step, seconds] : report.seconds) {
        EXPECT_GE(seconds, 0) << step;
        sum += seconds;
    }
    EXPECT_LE(sum, took) << "more than there was";
    return sum / took;
}

/// Something else may take the processor while a call returns; but not most of the time, again and again.
void expect_told(const char* what, const std::function<Report()>& run) {
    double best = 0;
    for (int k = 0; k < 5 && best < 0.9; ++k) best = std::max(best, told(run));
    EXPECT_GE(best, 0.9) << what;
}

TEST(ReportSecondsTest, AreThoseOfTheCall) {
    const Mesh mesh = read(std::filesystem::path(FEMSCALPEL_TEST_MESHES) / "two_boxes_39k.inp");
    const Cylinder hole({6, 5, 5}, {0.1, 0.2, 1}, 2), fine({6, 5, 5}, {0, 0, 1}, 0.3);
    const Tool *hole_tool = &hole, *fine_tool = &fine;
    const Plane plane({7.3, 5, 5}, {0.9, 0.3, 0.2});
    expect_told("crack", [&] { return crack(mesh, plane).report; });
    expect_told("drill", [&] { return drill(mesh, {&hole_tool, 1}).report; });
    expect_told("drill, refined first", [&] { return drill(mesh, {&fine_tool, 1}).report; });
    expect_told("cut", [&] { return cut(mesh, plane, 0.3).report; });
    RefineOptions o;
    o.size = 0.3;
    const DistanceField near_hole = distance_to(std::vector<const Tool*>{&hole});
    expect_told("refine", [&] { return refine(mesh, near_hole, o).report; });
    o.size = 100;
    expect_told("refine, nothing to do", [&] { return refine(mesh, near_hole, o).report; });
}

TEST(ReportSecondsTest, HoldAttemptsThatCameToNothing) {
    // A coarse second-order block and a hole as fine as its elements: several attempts, the best of which is taken in
    // the end.
    const Mesh mesh = checks::second_order(checks::grid(5, 5, 5));
    const Cylinder hole({2.53, 2.4, 0}, {0, 0.1, 1}, 0.9);
    const Tool* tool = &hole;
    DrillOptions options;
    options.refine.when = RefineFirst::When::never;
    expect_told("drill", [&] { return drill(mesh, {&tool, 1}, options).report; });
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
