// SPDX-License-Identifier: LGPL-2.1-or-later
// How often a cut is tried, with what, and what is made of its results.
#include "cutting/retry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Plane away({100, 0, 0}, {1, 0, 0});

struct Retry : testing::Test {
    Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, away);
    int middle = node_at(f.d.band, {1, 1, 1}), end = node_at(f.d.band, {2, 1, 1});
    int calls = 0;

    /// Moves the middle node so that the worst element has a mean ratio of about 0.06.
    void spoil(Workpiece& g) const { g.d.band.nodes[middle].at.x() = 1.985; }
};

TEST_F(Retry, OneTryIsEnoughWhenAllIsWell) {
    cut_soundly(
        f,
        [&](Workpiece& g) {
            ++calls;
            g.d.band.nodes[middle].at.x() = 1.1;
        },
        mesh.cell_count());
    EXPECT_EQ(calls, 1);
    EXPECT_EQ(f.d.band.nodes[middle].at.x(), 1.1);
    EXPECT_THAT(f.warnings, IsEmpty());
}

TEST_F(Retry, BeginsAnewWithOtherChoicesWhereANodeIsOffItsTool) {
    std::vector<int> off_tool, nodes;
    const auto cut = [&](Workpiece& g) {
        off_tool.push_back(static_cast<int>(std::ranges::count(g.d.off_tool, 1)));
        nodes.push_back(g.d.band.size());
        if (nodes.size() == 3) return;  // now it is sound
        g.split_edge(middle, end, Vec3(1.5, 1, 1), &away);
    };
    cut_soundly(f, cut, mesh.cell_count());
    ASSERT_EQ(nodes.size(), 3u);
    EXPECT_EQ(nodes[0], 27);
    EXPECT_EQ(nodes[1], 27) << "what the first try made is gone";
    EXPECT_GT(nodes[2], 27) << "elements were refined";
    EXPECT_EQ(off_tool[0], 0);
    EXPECT_GT(off_tool[1], 0) << "nodes there are not to be put on the tool";
    EXPECT_EQ(off_tool[2], 0);
}

TEST_F(Retry, GivesUpAndSaysWhere) {
    const auto cut = [&](Workpiece& g) {
        ++calls;
        g.split_edge(middle, end, Vec3(1.5, 1, 1), &away);
    };
    EXPECT_THAT([&] { cut_soundly(f, cut, mesh.cell_count(), 1); },
                testing::ThrowsMessage<QualityError>(
                    AllOf(HasSubstr("no sound elements were found where the plane meets the skin near ("),
                          HasSubstr("the mesh is too coarse there"))));
    EXPECT_EQ(calls, 1);
}

TEST_F(Retry, TakesWhatAPlaneThroughFlatSurfacesLeavesPoor) {
    cut_soundly(
        f,
        [&](Workpiece& g) {
            ++calls;
            spoil(g);
        },
        mesh.cell_count(), 12, true);
    EXPECT_EQ(calls, 1) << "refining would not help";
    EXPECT_EQ(f.d.band.nodes[middle].at.x(), 1.985);
    EXPECT_THAT(f.warnings, IsEmpty()) << "others say so";
}

TEST_F(Retry, TakesTheBestOfPoorResultsAndSaysSo) {
    const auto cut = [&](Workpiece& g) {
        spoil(g);
        if (++calls > 1) g.d.band.nodes[middle].at.x() = 1.9;
    };
    cut_soundly(f, cut, mesh.cell_count(), 1);
    EXPECT_EQ(calls, 1);
    EXPECT_THAT(f.warnings, ElementsAre(HasSubstr("elements there come out with a mean ratio of 0.0")));
}

TEST_F(Retry, TriesToHoldNodesThatTheToolPassed) {
    std::vector<double> parts;
    const auto cut = [&](Workpiece& g) {
        parts.push_back(g.part_to_hold(middle));
        if (parts.size() > 1) return;
        spoil(g);
        g.passed[middle] = 1e-3;
    };
    cut_soundly(f, cut, mesh.cell_count(), 12, true);
    EXPECT_THAT(parts, ElementsAre(close_beside, 2e-3));
    EXPECT_EQ(f.d.band.nodes[middle].at.x(), 1);
}

struct RetrySecondOrder : testing::Test {
    Mesh mesh = checks::second_order(checks::grid(2, 2, 2));
    Workpiece f = checks::whole_workpiece(mesh, away);
    int middle = node_at(f.d.band, {1, 1, 1}), end = node_at(f.d.band, {2, 1, 1});
    int calls = 0;

    /// Folds the elements around an edge.
    void fold(Workpiece& g) const {
        g.d.mids.set_bulge(middle, end, Vec3(0.3, 0, 0));
        g.d.band.nodes[middle].at.y() += 1e-6;
    }
};

TEST_F(RetrySecondOrder, StraightensElementsThatStayFolded) {
    cut_soundly(
        f,
        [&](Workpiece& g) {
            ++calls;
            fold(g);
        },
        mesh.cell_count(), 1);
    EXPECT_EQ(calls, 1) << "then they are as good as any";
    EXPECT_TRUE(f.d.mids.is_straightened(middle, end));
    EXPECT_TRUE(f.d.mids.bulge(middle, end).isZero(0));
}

TEST_F(RetrySecondOrder, CutsAsIfElementsWereLinearWhereCornersAreFoldedToo) {
    std::vector<bool> curved;
    cut_soundly(
        f,
        [&](Workpiece& g) {
            curved.push_back(g.d.mids.any());
            fold(g);
            if (g.d.mids.any()) g.d.band.nodes[middle].at.x() = 2.5;
        },
        mesh.cell_count(), 1);
    EXPECT_THAT(curved, ElementsAre(true, false));
    EXPECT_TRUE(f.d.mids.any()) << "they are curved again";
    EXPECT_NEAR(f.d.band.nodes[middle].at.x(), 1, 1e-9);
    EXPECT_TRUE(f.d.mids.is_straightened(middle, end));
}

TEST_F(RetrySecondOrder, CountsLipsAmongWhatAMeshGrowsBy) {
    // Where the second try is better, but four times as many elements were to come of it.
    for (const bool whole_tool : {false, true}) {
        Workpiece g = f;
        calls = 0;
        cut_soundly(
            g,
            [&](Workpiece& w) {
                w.d.band.nodes[middle].at.x() = ++calls == 1 ? 1.985 : 0.02;
                w.nodes.assign(static_cast<std::size_t>(mesh.cell_count()), middle);
            },
            mesh.cell_count(), 2, whole_tool);
        EXPECT_EQ(calls, 3) << "two tries, and one as if all edges were straight, as the best is poor";
        EXPECT_EQ(g.d.band.nodes[middle].at.x(), whole_tool ? 1.985 : 0.02);
    }
}

TEST_F(RetrySecondOrder, HoldsNodesThatTheToolPassedWhereElementsAreFolded) {
    for (const std::size_t spoilt : {1U, 2U}) {
        Workpiece g = f;
        std::vector<double> parts;
        cut_soundly(
            g,
            [&](Workpiece& w) {
                parts.push_back(w.part_to_hold(middle));
                if (parts.size() > spoilt) return;
                fold(w);
                w.d.band.nodes[middle].at.x() = 2.5;
                w.passed[middle] = 1e-3;
            },
            mesh.cell_count(), 12, true);
        if (spoilt == 1)
            EXPECT_THAT(parts, ElementsAre(close_beside, 2e-3));
        else
            EXPECT_THAT(parts, ElementsAre(close_beside, 2e-3, close_beside)) << "it helped nothing";
        EXPECT_EQ(g.d.band.nodes[middle].at.x(), 1);
    }
}

TEST_F(RetrySecondOrder, GivesUpWhereCornersStayFolded) {
    const auto cut = [&](Workpiece& g) {
        fold(g);
        g.d.band.nodes[middle].at.x() = 2.5;
    };
    EXPECT_THROW(cut_soundly(f, cut, mesh.cell_count(), 1), QualityError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
