// SPDX-License-Identifier: LGPL-2.1-or-later
// Lines that become edges of a surface.
#include "cutting/imprint.h"

#include <gtest/gtest.h>

#include "cutting/surface_line.h"
#include "mesh/quality.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// Across the top of a block of 4 x 4 x 1 cubes, from one place to another.
struct Block {
    Mesh mesh = checks::grid(4, 4, 1);
    Workpiece f = checks::whole_workpiece(mesh, checks::away);

    ImprintedLine imprint(const std::vector<Vec3>& places, bool closed = false) {
        ribbons.push_back(std::make_unique<Ribbon>(places, std::vector<Vec3>(places.size(), Vec3::UnitZ()), closed));
        ImprintLine line{ribbons.back().get(), {}, places, std::vector<Index>(places.size(), -1)};
        for (const Vec3& x : places) line.stops.push_back(line.ribbon->foot(x).arc);
        line.stops.front() = 0;
        imprints.push_back(std::make_unique<Imprint>(std::vector{line}, false));
        imprints.back()->run(f);
        return imprints.back()->result(f).front();
    }

    double volume() const {
        double sum = 0;
        for (int t = 0; t < f.d.band.tetras.size(); ++t) {
            const auto& n = f.d.band.tetras[t];
            const auto at = [&](int k) { return f.d.band.nodes[n[k]].at; };
            const double v = signed_volume(at(0), at(1), at(2), at(3));
            EXPECT_GT(v, 0);
            sum += v;
        }
        return sum;
    }

    std::vector<std::unique_ptr<Ribbon>> ribbons;
    std::vector<std::unique_ptr<Imprint>> imprints;
};

TEST(Imprint, MakesALineEdgesOfTheSkin) {
    Block block;
    const std::vector<Vec3> places{{0.6, 0.7, 1}, {3.3, 2.9, 1}};
    const ImprintedLine line = block.imprint(places);
    ASSERT_GE(line.nodes.size(), 3u);
    const BandMesh& band = block.f.d.band;
    for (std::size_t k = 0; k < line.nodes.size(); ++k) {
        const Vec3& x = band.nodes[line.nodes[k]].at;
        EXPECT_NEAR(x[2], 1, 1e-12);
        EXPECT_NEAR(block.ribbons[0]->distance(x), 0, 1e-9);
        if (k > 0) {
            const int a = line.nodes[k - 1], b = line.nodes[k];
            EXPECT_TRUE(std::ranges::any_of(
                band.skin.around(a), [&](int s) { return std::ranges::find(band.skin[s], b) != band.skin[s].end(); }));
            EXPECT_GE(band.cut_edges.find({a, b}), 0);
        }
    }
    for (const std::size_t end : {0U, 1U})
        EXPECT_NEAR((band.nodes[line.at_stop[end]].at - places[end]).norm(), 0, 1e-9);
    EXPECT_NEAR(block.volume(), 16, 1e-12);
}

TEST(Imprint, MakesStopsNodes) {
    Block block;
    const ImprintedLine line = block.imprint({{0.6, 1.3, 1}, {1.4, 1.3, 1}, {2.2, 1.3, 1}, {3.4, 1.3, 1}});
    ASSERT_EQ(line.at_stop.size(), 4u);
    const double x[] = {0.6, 1.4, 2.2, 3.4};
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR((block.f.d.band.nodes[line.at_stop[k]].at - Vec3(x[k], 1.3, 1)).norm(), 0, 1e-9);
}

TEST(Imprint, GoesThroughNodesThatAreThere) {
    Block block;
    const ImprintedLine line = block.imprint({{1, 1, 1}, {3, 1, 1}});
    ASSERT_EQ(line.nodes.size(), 3u);
    for (const int k : {1, 2, 3}) {
        const BandNode& node = block.f.d.band.nodes[line.nodes[static_cast<std::size_t>(k - 1)]];
        EXPECT_EQ(node.at, node.start);
        EXPECT_EQ(node.at, Vec3(k, 1, 1));
    }
}

TEST(Imprint, FollowsAClosedLineThatTurns) {
    Block block;
    std::vector<Vec3> circle;
    for (int k = 0; k < 16; ++k)
        circle.emplace_back(2.1 + 1.3 * std::cos(k * M_PI / 8), 1.9 + 1.3 * std::sin(k * M_PI / 8), 1);
    const ImprintedLine line = block.imprint(circle, true);
    EXPECT_GE(line.nodes.size(), 16u);
    double area = 0;
    for (std::size_t k = 0; k < line.nodes.size(); ++k) {
        const Vec3 &a = block.f.d.band.nodes[line.nodes[k]].at,
                   &b = block.f.d.band.nodes[line.nodes[(k + 1) % line.nodes.size()]].at;
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    EXPECT_NEAR(area, 8 * 1.3 * 1.3 * std::sin(M_PI / 8), 0.05);
    EXPECT_NEAR(block.volume(), 16, 1e-12);
}

TEST(Imprint, WhatIsOnNoSurfaceIsAnError) {
    Block block;
    EXPECT_THROW(block.imprint({{0.6, 0.7, 9}, {3.3, 2.9, 9}}), QualityError);
}

TEST(Imprint, KeepsTheEdgesThatALineHasAlready) {
    Block block;
    const std::vector<Vec3> places{{1, 1, 1}, {2, 1, 1}, {2.5, 1.2, 1}};
    const Ribbon ribbon(places, std::vector<Vec3>(3, Vec3::UnitZ()), false);
    const Index a = checks::number_near(block.mesh, places[0]), b = checks::number_near(block.mesh, places[1]);
    const Imprint imprint({{&ribbon, {0, 1, 1.5}, places, {a, b, -1}}}, false);
    imprint.keep_edges(block.f);
    ASSERT_EQ(block.f.kept_edges.size(), 1);
    const auto [first, second] = *block.f.kept_edges.begin();
    const BandMesh& band = block.f.d.band;
    EXPECT_LT(first, second);
    EXPECT_EQ((std::set{band.nodes[first].global, band.nodes[second].global}), (std::set{a, b}));
    EXPECT_TRUE(block.f.d.mids.is_kept(first, second));
    const Imprint apart({{&ribbon, {0, 1}, {places[0], {4, 4, 1}}, {a, checks::number_near(block.mesh, {4, 4, 1})}}},
                        false);
    block.f.kept_edges.clear();
    apart.keep_edges(block.f);
    EXPECT_TRUE(block.f.kept_edges.empty());  // there is no edge between them
}

TEST(SurfaceLine, BordersInsideTheMaterialAreNoSurface) {
    const Mesh mesh = checks::two_halves();
    const Workpiece f = checks::whole_workpiece(mesh, checks::away);
    int surface = 0;
    for (int s = 0; s < f.d.band.skin.size(); ++s) surface += is_surface_face(f.d, s);
    EXPECT_EQ(surface, 6 * 8);
    EXPECT_EQ(f.d.band.skin.size(), 6 * 8 + 8);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
