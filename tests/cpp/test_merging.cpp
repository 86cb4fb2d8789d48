// SPDX-License-Identifier: LGPL-2.1-or-later
// Nodes moved onto neighbours (as improve() uses it, see test_improve.cpp).
#include "cutting/merging.h"

#include <gtest/gtest.h>

#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;

TEST(Merging, GoesWhereElementsGetBetter) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    const int middle = node_at(f.d.band, {1, 1, 1});
    const int born = f.split_edge(middle, node_at(f.d.band, {2, 1, 1}), Vec3(1.05, 1, 1), {});
    EXPECT_TRUE(in_one(f.d.band.tetras, born, middle));
    EXPECT_EQ(NodeMerger(f).merge(born), middle);
    EXPECT_FALSE(f.d.band.in_use(born));
}

TEST(Merging, StaysWhereElementsWouldNot) {
    const Mesh mesh = checks::grid(2, 2, 2);
    Workpiece f = checks::whole_workpiece(mesh, checks::away);
    EXPECT_EQ(NodeMerger(f).merge(node_at(f.d.band, {1, 1, 1})), -1);
    EXPECT_EQ(NodeMerger(f).merge(node_at(f.d.band, {2, 2, 2})), -1) << "a corner of the skin";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
