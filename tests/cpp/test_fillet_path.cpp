// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

FilletPath path_near(const Mesh& mesh, const Vec3& near, double radius) {
    return {mesh, find_feature_lines(mesh, {{}, {}, {near}}, 30).at(0), radius, skin_of(mesh)};
}

TEST(FilletPath, EdgeOfABox) {
    const FilletPath path = path_near(checks::grid(5, 4, 4), {2.4, 0, 0}, 1.5);
    EXPECT_TRUE(path.is_straight());
    EXPECT_TRUE(path.convex());
    EXPECT_FALSE(path.closed());
    EXPECT_NEAR(path.length(), 5, 1e-12);
    EXPECT_NEAR(path.tangent_length(), 1.5, 1e-12);
    EXPECT_NEAR(path.arc_angle(), M_PI / 2, 1e-12);
    EXPECT_EQ(path.ball().kind(), "cylinder");
    const Vec3 x(1.2, 0.3, 0.4);
    const auto [s, p] = path.place(x);
    EXPECT_LT((path.at(s, p) - x).norm(), 1e-12);
    EXPECT_NEAR(path.ball().distance({3, 1.5, 0}), 0, 1e-12);
    EXPECT_NEAR(path.ball().distance({3, 0, 1.5}), 0, 1e-12);
    EXPECT_NEAR(path.wall(0).distance({3, 1.5, 1.5}), 0, 1e-12);
    EXPECT_NEAR(path.wall(1).distance({3, 1.5, 1.5}), 0, 1e-12);
    EXPECT_NEAR(std::abs(path.wall(0).normal(x).dot(path.wall(1).normal(x))), 0, 1e-12);
    for (const double angle : {0.0, 0.3, path.arc_angle()})
        EXPECT_NEAR(path.ball().distance(path.at(2, path.arc(angle))), 0, 1e-12);
    EXPECT_NEAR(path.distance({-2, 0, 0}, 0.5), 1.5, 1e-12);
}

/// A mesh of tetrahedra without those whose middle is where `gone` is true.
template <class Gone>
Mesh without(Mesh mesh, Gone gone) {
    CellBlock& block = mesh.block(CellType::tetra);
    CellBlock kept = block;
    kept.connectivity.clear(), kept.ids.clear(), kept.families.clear();
    for (Index c = 0; c < block.size(); ++c) {
        Vec3 centre = Vec3::Zero();
        for (const Index n : block.nodes(c)) centre += mesh.points[n] / 4;
        if (gone(centre)) continue;
        kept.connectivity.insert(kept.connectivity.end(), block.nodes(c).begin(), block.nodes(c).end());
        kept.ids.push_back(block.ids[c]);
        kept.families.push_back(0);
    }
    block = kept;
    return mesh;
}

/// Four cubes by four by two, without those beyond a concave edge at x = y = 2.
Mesh l_shape() {
    return without(checks::grid(4, 4, 2), [](const Vec3& x) { return x.x() > 2 && x.y() > 2; });
}

TEST(FilletPath, ConcaveEdge) {
    const Mesh mesh = l_shape();
    const FilletPath path = path_near(mesh, {2, 2, 1}, 1);
    EXPECT_FALSE(path.convex());
    EXPECT_NEAR(path.ball().distance({3, 3, 1}), -1, 1e-12);
    EXPECT_NEAR((path.at(1, path.centre()) - path.at(1, Vec2::Zero())).norm(), std::sqrt(2.0), 1e-12);
    EXPECT_THROW(path_near(mesh, {2, 2, 1}, 2.1), ToolError);
}

/// The upper edge of a plate with round ends; its faces are made by hand.
TEST(FilletPath, StraightPiecesAndArcsThatJoinSmoothly) {
    Mesh mesh;
    FeatureLine line;
    line.closed = true;
    constexpr int parts = 6;
    std::vector<Vec2> outline;
    for (int k = 0; k < 4; ++k) outline.emplace_back(k, 0);
    for (int k = 0; k < parts; ++k)
        outline.emplace_back(4 + std::sin(k * M_PI / parts), 1 - std::cos(k * M_PI / parts));
    for (int k = 0; k < 4; ++k) outline.emplace_back(4 - k, 2);
    for (int k = 0; k < parts; ++k) outline.emplace_back(-std::sin(k * M_PI / parts), 1 + std::cos(k * M_PI / parts));
    const int n = static_cast<int>(outline.size());
    for (const double z : {1.0, 0.0})
        for (const Vec2& p : outline) mesh.add_node({p.x(), p.y(), z}, mesh.node_count() + 1);
    const Index middle = mesh.add_node({2, 1, 1}, mesh.node_count() + 1);
    std::vector<std::array<Index, 3>> skin;
    for (int k = 0; k < n; ++k) {
        const Index a = k, b = (k + 1) % n;
        line.nodes.push_back(a);
        // The point inside is on the plane, but not straight across from arcs; one beside the edge is.
        const Vec3 across = (mesh.points[a] + mesh.points[b]) / 2 * 0.9 + mesh.points[middle] * 0.1;
        const Index inside = mesh.add_node(across, mesh.node_count() + 1);
        line.faces.push_back({std::array<Index, 3>{a, b, inside}, std::array<Index, 3>{b, a, a + n}});
        skin.push_back({a, b, middle});
        skin.push_back({b, a, a + n});
        skin.push_back({b, a + n, b + n});
    }
    const FilletPath path(mesh, line, 0.4, skin);
    EXPECT_TRUE(path.convex());
    EXPECT_TRUE(path.closed());
    EXPECT_NEAR(path.length(), 8 + 2 * M_PI, 1e-9);
    for (int k = 0; k < 40; ++k) {
        const double s = (k + 0.3) * path.length() / 40;
        for (const Vec2& p : {Vec2(0.3, -0.2), Vec2(-0.3, 0.1), Vec2(0, 0)}) {
            const auto [found, q] = path.place(path.at(s, p));
            EXPECT_NEAR(found, s, 1e-9);
            EXPECT_LT((q - p).norm(), 1e-9);
        }
    }
    EXPECT_NEAR(path.ball().distance({2, 0.4, 1}), 0, 1e-9);
    EXPECT_NEAR(path.ball().distance({5, 1, 0.6}), 0, 1e-9);
}

TEST(FilletPath, RoomIsSeenInAFineMesh) {
    Mesh mesh = checks::grid(12, 12, 12);
    EXPECT_NO_THROW(path_near(mesh, {2.4, 0, 0}, 3.95)) << "the tangent point lies close before the end of an element";
    EXPECT_NO_THROW(path_near(mesh, {2.4, 0, 0}, 11));
}

TEST(FilletPath, EndsOfLines) {
    const Mesh mesh = l_shape();
    const auto ends = [&](const Mesh& of, const Vec3& near) {
        return line_ends(of, find_feature_lines(of, {{}, {}, {near}}, 30).at(0), skin_of(of));
    };
    using enum LineEnd;
    EXPECT_THAT(ends(mesh, {2, 2, 1}), testing::ElementsAre(plane, plane));
    EXPECT_THAT(ends(mesh, {0, 2, 2}), testing::ElementsAre(plane, plane));
    EXPECT_THAT(ends(mesh, {4, 0, 1}), testing::ElementsAre(plane, plane));
    EXPECT_THAT(ends(mesh, {3, 2, 2}), testing::UnorderedElementsAre(plane, open)) << "at the concave edge";
    const FilletPath path(mesh, find_feature_lines(mesh, {{}, {}, {{3, 2, 2}}}, 30).at(0), 0.8, skin_of(mesh),
                          {ends(mesh, {3, 2, 2})});
    EXPECT_NEAR(path.length(), 2, 1e-12) << "the faces reach up to the concave edge";
    const int open_end = path.end_kind(0) == open ? 0 : 1;
    EXPECT_NEAR(path.end_plane(open_end).distance({2, 1, 1}), 0, 1e-12);
    EXPECT_TRUE(path.is_beyond_end({1.9, 2, 2}));
    EXPECT_FALSE(path.is_beyond_end({2.1, 2, 2}));
}

/// Three walls of a room: a block without one of its octants.
Mesh room() {
    return without(checks::grid(4, 4, 4), [](const Vec3& x) { return x.minCoeff() > 2; });
}

TEST(FilletPath, EndsInAWall) {
    const Mesh mesh = room();
    EXPECT_THAT(line_ends(mesh, find_feature_lines(mesh, {{}, {}, {{2, 2, 3}}}, 30).at(0), skin_of(mesh)),
                testing::UnorderedElementsAre(LineEnd::plane, LineEnd::wall));
}

TEST(FilletPath, RadiusTooLargeNamesFaceAndParameter) {
    try {
        path_near(checks::grid(5, 2, 4), {2.4, 0, 0}, 2.2);
        FAIL();
    } catch (const ToolError& e) {
        EXPECT_STREQ(e.parameter(), "radius");
        EXPECT_THAT(e.what(), testing::HasSubstr("2.2 is too large for a face beside the edge"));
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
