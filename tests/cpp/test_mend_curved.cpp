// SPDX-License-Identifier: LGPL-2.1-or-later
// Second-order elements that came out folded, around the middle node of a cube of eight.
#include "cutting/mend_curved.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "random_numbers.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::IsEmpty;

const Plane away({100, 0, 0}, {1, 0, 0});

/// The middle node has moved, and the mid-side node of the edge from there along x lies `bulge` along the edge.
struct MendCurved : testing::Test {
    Mesh mesh = checks::second_order(checks::grid(2, 2, 2));
    Workpiece f = checks::whole_workpiece(mesh, away);
    int middle = node_at(f.d.band, {1, 1, 1}), end = node_at(f.d.band, {2, 1, 1});

    void bend(double bulge) { f.d.mids.set_bulge(middle, end, Vec3(bulge, 0, 0)); }
    void move() { f.d.band.nodes[middle].at.y() += 1e-6; }
};

TEST_F(MendCurved, FindsFoldedElementsThatWereChanged) {
    bend(0.19);
    EXPECT_THAT(folded_elements(f, 0.3), IsEmpty()) << "nothing was changed";
    move();
    EXPECT_THAT(folded_elements(f, 0.2), IsEmpty());
    const std::vector<BandElement> found = folded_elements(f, 0.3);
    EXPECT_EQ(found.size(), 6u) << "those around the edge";
    double last = -1;
    for (const BandElement e : found) {
        EXPECT_FALSE(e.triangle);
        const double ratio = curved_shape(f.d, e);
        EXPECT_NEAR(ratio, 1 - 4 * 0.19, 1e-5);
        EXPECT_GE(ratio, last) << "worst first";
        last = ratio;
    }
    bend(0.21);
    EXPECT_EQ(folded_elements(f, least_curved).size(), 6u) << "a mid-side node off by a fifth of its edge does not fit";
}

TEST_F(MendCurved, FindsElementsOnATool) {
    bend(0.26);
    f.d.contact[end] = &away;
    EXPECT_EQ(folded_elements(f, least_curved).size(), 6u);
}

TEST_F(MendCurved, PutsMidSideNodesInTheMiddle) {
    bend(0.26);
    move();
    mend_curved(f);
    EXPECT_TRUE(f.d.mids.bulge(middle, end).isZero(0));
    EXPECT_THAT(folded_elements(f, 0.1), IsEmpty());
    EXPECT_EQ(f.d.band.size(), 27) << "that was enough";
}

TEST_F(MendCurved, LeavesSoundElementsAlone) {
    bend(0.1);
    move();
    mend_curved(f);
    EXPECT_EQ(f.d.mids.bulge(middle, end), Vec3(0.1, 0, 0));
}

/// Smallest mean ratio by corners, negative when inverted.
double worst_by_corners(const Workpiece& f) {
    double worst = 1;
    for (int t = 0; t < f.d.band.tetras.size(); ++t)
        if (f.d.band.tetras.alive(t)) worst = std::min(worst, tetra_quality(f.d, t));
    return worst;
}

TEST(MendCurvedAtRandom, InvertsNoElementByItsCorners) {
    const Mesh mesh = checks::second_order(checks::grid(2, 2, 2));
    checks::Random random(3);
    int mended = 0, folded = 0;
    for (int n = 0; n < 25; ++n) {
        Workpiece f = checks::whole_workpiece(mesh, away);
        const int middle = node_at(f.d.band, {1, 1, 1});
        std::vector<int> neighbours;
        for (int v = 0; v < 27; ++v) {
            f.d.band.neighbours(v, neighbours);
            for (const int w : neighbours)
                if (v < w && random.uniform() < 0.2)
                    f.d.mids.set_bulge(v, w, random.uniform(0, 0.6) * random.direction());
        }
        f.d.band.nodes[middle].at += random.uniform(0, 0.3) * random.direction();
        ASSERT_GT(worst_by_corners(f), 0);
        const std::size_t before = folded_elements(f, least_curved).size();
        mend_curved(f, n % 2 == 0);
        EXPECT_GT(worst_by_corners(f), 0) << n;
        const std::size_t after = folded_elements(f, least_curved).size();
        mended += after < before;
        folded += after > 0;
    }
    EXPECT_GT(mended, 5);
    EXPECT_GT(folded, 5) << "some cannot be mended";
}

TEST(MendCurvedLinear, HasNothingToDo) {
    const Mesh mesh = checks::grid(1, 1, 1);
    Workpiece f = checks::whole_workpiece(mesh, away);
    f.d.band.nodes[0].at.x() += 0.3;
    EXPECT_THAT(folded_elements(f, 1), IsEmpty());
    const Vec3 at = f.d.band.nodes[0].at;
    mend_curved(f);
    EXPECT_EQ(f.d.band.nodes[0].at, at);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
