// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether second-order elements stay sound when a node moves: the quick answer is the one that looking at every element
// gives.
#include <gtest/gtest.h>

#include <random>

#include "deformation/curved_shape.h"
#include "io/inp.h"
#include "mesh/band_mesh.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

double worst_around(const Deformable& d, int node) {
    double worst = 1;
    for_second_order_around(d, node, [&](BandElement e) { worst = std::min(worst, curved_shape(d, e)); });
    return worst;
}

TEST(CurvedShape, QuickAnswersAreThoseOfEveryElement) {
    const Mesh mesh = read_inp(FEMSCALPEL_TEST_MESHES "/quadratic_elbow.inp");
    std::vector<std::int8_t> level(mesh.points.size());
    for (std::size_t v = 0; v < level.size(); ++v) level[v] = std::abs(mesh.points[v].y()) < 4 ? 0 : -1;
    Deformable d(extract_band(mesh, level), mesh, {});
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-1, 1);
    int sound = 0, spoiled = 0;
    for (int v = 0; v < d.band.size(); ++v) {
        if (!d.band.nodes[v].movable()) continue;
        const double before = worst_around(d, v);
        const Vec3 home = d.band.nodes[v].at;
        CurvedStar star(d, v);
        for (const double far : {0.05, 0.3, 0.6, 0.9}) {
            Vec3 x = home + far * d.band.mean_edge_length(v) * Vec3(shift(random), shift(random), shift(random));
            if (!d.constraints.project(v, {}, x)) continue;
            const bool quick = star.stays_sound(x);
            d.band.nodes[v].at = x;
            const double after = worst_around(d, v);
            d.band.nodes[v].at = home;
            EXPECT_EQ(quick, after >= curved_limit || (before < curved_limit && after >= before))
                << "node " << v << ": " << before << " -> " << after;
            ++(quick ? sound : spoiled);
        }
    }
    EXPECT_GT(sound, 100);
    EXPECT_GT(spoiled, 30);
}

TEST(CurvedShape, WhatIsSurelySoundIs) {
    const Mesh mesh = checks::second_order(checks::grid(5, 5, 5));
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(-1, 1);
    int surely = 0, folded = 0;
    std::vector<int> neighbours;
    for (const double most : {0.01, 0.03, 0.08, 0.2, 0.4}) {
        Deformable d(extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0)), mesh, {});
        for (int v = 0; v < d.band.size(); ++v) {
            d.band.neighbours(v, neighbours);
            for (const int w : neighbours)
                if (v < w && d.constraints[v].freedom == NodeFreedom::free &&
                    d.constraints[w].freedom == NodeFreedom::free)
                    d.mids.set_bulge(v, w, most * Vec3(part(random), part(random), part(random)));
            // Moved, so that mid-side nodes are looked at as those of changed elements.
            if (d.constraints[v].freedom == NodeFreedom::free) d.band.nodes[v].at += 0.02 * Vec3(part(random), 0, 0);
        }
        for (int t = 0; t < d.band.tetras.size(); ++t) {
            const double shape = curved_shape(d, {false, t});
            folded += shape < curved_limit;
            if (!is_surely_sound(d, {false, t})) continue;
            EXPECT_GE(shape, curved_limit) << "bulges of up to " << most;
            ++surely;
        }
    }
    EXPECT_GT(surely, 100);
    EXPECT_GT(folded, 100);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
