// SPDX-License-Identifier: LGPL-2.1-or-later
// Edges that are too long, and in which order they are bisected.
#include "cutting/bisection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::HasSubstr;

const Plane ground({0, 0, 0}, {0, 0, 1});

TEST(SizeField, GrowsWithTheDistance) {
    const DistanceField distance = distance_to(std::vector<const Tool*>{&ground});
    const BisectionOptions options{.size = 1, .gradation = 0.5};
    const SizeField field(distance, options);
    const auto exceeded = [&](const SizeField& f, const Vec3& a, const Vec3& b) {
        return f.exceeded(a, b, f.distance(a), f.distance(b));
    };
    EXPECT_EQ(field.distance({1, 2, -3}), -3);
    // Two above the ground edges may be two long.
    EXPECT_FALSE(exceeded(field, {0, 0, 2}, {1.9, 0, 2}));
    EXPECT_TRUE(exceeded(field, {0, 0, 2}, {2.1, 0, 2}));
    // What crosses the ground may be as long as what is on it.
    EXPECT_TRUE(exceeded(field, {0, 0, -2}, {0, 0, 0.1}));
    EXPECT_FALSE(exceeded(field, {0, 0, -0.5}, {0, 0, 0.4}));
    const BisectionOptions wide{.size = 1, .gradation = 0.5, .reach = 1};
    EXPECT_TRUE(exceeded(SizeField(distance, wide), {0, 0, 2}, {1.9, 0, 2})) << "it only grows from the reach on";
}

TEST(SizeField, LooksAtTheMiddleOfAnEdge) {
    const DistanceField distance = distance_to(std::vector<Vec3>{Vec3::Zero()});
    const BisectionOptions options{.size = 1, .gradation = 2};
    const SizeField field(distance, options);
    EXPECT_TRUE(field.exceeded({-2, 0, 0}, {2, 0, 0}, 2, 2)) << "its ends alone would allow for five";
    EXPECT_FALSE(field.exceeded({-2, 2, 0}, {2, 2, 0}, std::sqrt(8.0), std::sqrt(8.0)));
}

/// A band in which some nodes may move, to be bisected to one size everywhere.
struct Bisected {
    Bisected(const Mesh& m, std::vector<std::int8_t> level, double size, bool may_grow = true, Index most = 5'000'000)
        : mesh(m),
          d(extract_band(mesh, level), mesh, {}),
          options{.size = size, .gradation = 0, .relax = false, .max_elements = most},
          distance([](const Vec3&) { return 0.0; }),
          field(distance, options),
          bisector(d, mesh, field, options, std::vector<double>(static_cast<std::size_t>(d.band.size()), 0), may_grow) {
    }
    explicit Bisected(const Mesh& m, double size, Index most = 5'000'000)
        : Bisected(m, std::vector<std::int8_t>(m.points.size(), 0), size, true, most) {}

    Mesh mesh;
    Deformable d;
    BisectionOptions options;
    DistanceField distance;
    SizeField field;
    Bisector bisector;
};

TEST(Bisector, BisectsWhatIsTooLong) {
    // Only the diagonal of the cube is longer than 1.5.
    Bisected cube(checks::grid(1, 1, 1), 1.5);
    EXPECT_TRUE(cube.bisector.run());
    ASSERT_EQ(cube.d.band.size(), 9);
    EXPECT_EQ(cube.d.band.nodes[8].at, Vec3(0.5, 0.5, 0.5));
    EXPECT_EQ(cube.d.band.tetras.size(), 12);
    EXPECT_EQ(cube.bisector.left(), 0);
    EXPECT_EQ(cube.bisector.off_shape(), 0);
    Bisected coarse(checks::grid(1, 1, 1), 2);
    EXPECT_TRUE(coarse.bisector.run());
    EXPECT_EQ(coarse.d.band.size(), 8);
}

TEST(Bisector, LeavesNoEdgeTooLong) {
    Bisected cube(checks::grid(1, 1, 1), 0.6);
    EXPECT_TRUE(cube.bisector.run());
    const BandMesh& band = cube.d.band;
    for (int t = 0; t < band.tetras.size(); ++t)
        for (const int v : band.tetras[t])
            for (const int w : band.tetras[t]) EXPECT_LE((band.nodes[v].at - band.nodes[w].at).norm(), 0.6);
}

TEST(Bisector, RefusesMoreElementsThanAllowed) {
    EXPECT_NO_THROW(Bisected(checks::grid(1, 1, 1), 1.5, 12).bisector.run());
    Bisected cube(checks::grid(1, 1, 1), 1.5, 11);
    EXPECT_THAT([&] { cube.bisector.run(); },
                testing::ThrowsMessage<ToolError>(HasSubstr("would make more than 11 elements")));
}

/// A triangle whose longest edge, 1-2, is outside a band of node 0 alone; its edge 0-1 is 1.5 long.
Mesh triangle() {
    Mesh mesh;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(1.5, 0, 0), Vec3(0.2, 1, 0)}) mesh.add_node(at, mesh.node_count() + 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 1);
    return mesh;
}

TEST(Bisector, AsksForALargerBandWhereALongerEdgeIsOutside) {
    Bisected growing(triangle(), {0, -1, -1}, 1.2, true);
    EXPECT_FALSE(growing.bisector.run());
    Bisected rim(triangle(), {0, -1, -1}, 1.2, false);
    EXPECT_TRUE(rim.bisector.run());
    ASSERT_EQ(rim.d.band.size(), 4);
    EXPECT_EQ(rim.d.band.nodes[3].at, Vec3(0.75, 0, 0));
    // With all of it in the band the longest goes first.
    Bisected whole(triangle(), 1.6);
    EXPECT_TRUE(whole.bisector.run());
    ASSERT_EQ(whole.d.band.size(), 4);
    EXPECT_LT((whole.d.band.nodes[3].at - Vec3(0.85, 0.5, 0)).norm(), 1e-15);
}

TEST(Bisector, PutsNodesOfCurvedEdgesOnTheirCurves) {
    Mesh mesh = checks::second_order(triangle());
    mesh.points[checks::number_near(mesh, {0.85, 0.5, 0})] = {0.9, 0.6, 0};
    Bisected whole(mesh, 1.6);
    EXPECT_TRUE(whole.bisector.run());
    ASSERT_EQ(whole.d.band.size(), 4);
    EXPECT_EQ(whole.d.band.nodes[3].at, Vec3(0.9, 0.6, 0));
    // A quarter of the way along the curve: l1 (2 l1 - 1) x1 + l2 (2 l2 - 1) x2 + 4 l1 l2 x12.
    const Vec3 quarter = 0.375 * mesh.points[1] - 0.125 * mesh.points[2] + 0.75 * Vec3(0.9, 0.6, 0);
    EXPECT_LT((whole.bisector.mid_side(1, 3) - quarter).norm(), 1e-15);
    EXPECT_LT((whole.bisector.middle(1, 3) - quarter).norm(), 1e-15);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
