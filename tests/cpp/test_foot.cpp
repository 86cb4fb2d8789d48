// SPDX-License-Identifier: LGPL-2.1-or-later
// Closest points of kept surfaces and curves, on geometries of a few pieces.
#include "deformation/foot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace femscalpel {
namespace FILE_NAMESPACE {

constexpr NodeConstraint on_surface{NodeFreedom::surface, 0, 0}, on_curve{NodeFreedom::curve, 0, 0};

/// A geometry made by hand, with one surface and one curve that are not flat and straight.
struct Pieces {
    explicit Pieces(std::vector<Vec3> nodes) : points(std::move(nodes)) {
        g.surfaces.push_back({.flat = false});
        g.curves.push_back({.straight = false});
        g.facets_around.resize(points.size());
        g.segments_around.resize(points.size());
    }

    void add_facet(const std::array<int, 3>& node, int surface = 0) {
        KeptGeometry::Facet f;
        f.node = node;
        f.shape = surface;
        for (int k = 0; k < 3; ++k) f.corner[k] = points[node[k]];
        double longest = 0;
        for (int k = 0; k < 3; ++k) {
            f.mid[k] = (f.corner[k] + f.corner[(k + 1) % 3]) / 2;
            longest = std::max(longest, (f.corner[k] - f.corner[(k + 1) % 3]).norm());
        }
        f.centre = (f.corner[0] + f.corner[1] + f.corner[2]) / 3;
        for (const Vec3& p : f.corner) f.radius = std::max(f.radius, (p - f.centre).norm());
        f.height = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).norm() / longest;
        for (const int v : node) g.facets_around[v].push_back(static_cast<int>(g.facets.size()));
        g.facets.push_back(f);
    }

    void add_segment(int a, int b, int curve = 0) {
        KeptGeometry::Segment s;
        s.node = {a, b};
        s.shape = curve;
        s.end = {points[a], points[b]};
        s.mid = s.centre = (points[a] + points[b]) / 2;
        s.radius = (points[a] - points[b]).norm() / 2;
        for (const int v : {a, b}) g.segments_around[v].push_back(static_cast<int>(g.segments.size()));
        g.segments.push_back(s);
    }

    std::vector<Vec3> points;
    KeptGeometry g;
};

/// Two triangles that meet in a ridge x = 0, z = 1 and go down to z = 0 at x = -1 and x = 1.
Pieces roof() {
    Pieces roof({{0, 0, 1}, {0, 1, 1}, {-1, 0.5, 0}, {1, 0.5, 0}});
    roof.add_facet({0, 1, 2});
    roof.add_facet({1, 0, 3});
    return roof;
}

TEST(Foot, WalksAcrossAnEdge) {
    const Pieces p = roof();
    const Vec3 on(0.5, 0.5, 0.5), up = Vec3(1, 0, 1).normalized();
    const Foot foot = surface_foot(p.g, on_surface, on + 0.3 * up);
    EXPECT_EQ(foot.piece, 1);
    EXPECT_LT((foot.at - on).norm(), 1e-14);
    EXPECT_NEAR(std::abs(foot.normal.dot(up)), 1, 1e-14);
    EXPECT_NEAR(foot.distance2, 0.09, 1e-14);
}

TEST(Foot, StaysOnItsSurface) {
    Pieces p = roof();
    p.g.surfaces.push_back(p.g.surfaces[0]);
    p.g.facets[1].shape = 1;
    const Foot foot = surface_foot(p.g, on_surface, Vec3(0.5, 0.5, 0.5));
    EXPECT_EQ(foot.piece, 0);
    EXPECT_LT((foot.at - Vec3(0, 0.5, 1)).norm(), 1e-14) << "the ridge, where its own facet ends";
}

TEST(Foot, OfAPlaneIsBeyondItsFacets) {
    Pieces p = roof();
    p.g.surfaces[0] = {.flat = true, .normal = Vec3(0, 0.6, 0.8), .origin = Vec3(1, 2, 3)};
    const Vec3 on = Vec3(1, 2, 3) + 50 * Vec3::UnitX() - 20 * Vec3(0, 0.8, -0.6);
    const Foot foot = surface_foot(p.g, on_surface, on - 7 * Vec3(0, 0.6, 0.8));
    EXPECT_LT((foot.at - on).norm(), 1e-13);
    EXPECT_EQ(foot.normal, Vec3(0, 0.6, 0.8));
    EXPECT_NEAR(foot.distance2, 49, 1e-12);
    EXPECT_EQ(foot.piece, 0);
}

/// z of a paraboloid, which a six-node triangle is exactly.
Vec3 on_paraboloid(double x, double y) { return {x, y, 0.4 * x * x + 0.2 * x * y - 0.3 * y * y}; }

TEST(Foot, OfASecondOrderFacetIsOnTheCurvedFace) {
    Pieces p({on_paraboloid(0, 0), on_paraboloid(1, 0), on_paraboloid(0, 1)});
    p.add_facet({0, 1, 2});
    KeptGeometry::Facet& f = p.g.facets[0];
    f.mid = {on_paraboloid(0.5, 0), on_paraboloid(0.5, 0.5), on_paraboloid(0, 0.5)};
    f.curved = true;
    f.sag = 0.2;
    for (const double x : {0.1, 0.3, 0.6})
        for (const double y : {0.1, 0.3}) {
            const Vec3 on = on_paraboloid(x, y), normal = Vec3(-0.8 * x - 0.2 * y, 0.6 * y - 0.2 * x, 1).normalized();
            for (const double off : {-0.3, 0.0, 0.2}) {
                const Foot foot = foot_on(f, on + off * normal);
                EXPECT_LT((foot.at - on).norm(), 1e-12) << x << ' ' << y << ' ' << off;
                EXPECT_NEAR(std::abs(foot.normal.dot(normal)), 1, 1e-12);
                EXPECT_NEAR(foot.distance2, off * off, 1e-12);
                EXPECT_NEAR(foot.inside, std::min({x, y, 1 - x - y}), 1e-11);
            }
        }
    const Foot corner = foot_on(f, Vec3(-1, -1, 0));
    EXPECT_LT(corner.at.norm(), 1e-13) << "beyond the sides it is on them";
    EXPECT_TRUE(std::isinf(foot_on(f, Vec3(0.2, 0.2, 3), 1.0).distance2)) << "surely farther than the limit";
    EXPECT_FALSE(std::isinf(foot_on(f, Vec3(0.2, 0.2, 3), 10.0).distance2));
}

/// A line of four segments that bends in the plane z = 0.
Pieces line() {
    Pieces p({{0, 0, 0}, {1, 0, 0}, {2, 0.3, 0}, {3, 0.9, 0}, {3.5, 1.8, 0}});
    for (int k = 0; k < 4; ++k) p.add_segment(k, k + 1);
    return p;
}

TEST(Foot, WalksAlongALineToItsEnd) {
    const Pieces p = line();
    const Foot middle = curve_foot(p.g, on_curve, Vec3(2.5, 0.6, 0) + 0.2 * Vec3(-0.6, 1, 0));
    EXPECT_EQ(middle.piece, 2);
    EXPECT_LT((middle.at - Vec3(2.5, 0.6, 0)).norm(), 1e-14);
    EXPECT_NEAR(std::abs(middle.normal.dot(Vec3(1, 0.6, 0).normalized())), 1, 1e-14);
    const Foot end = curve_foot(p.g, on_curve, Vec3(4.5, 3.8, 0.5));
    EXPECT_EQ(end.piece, 3);
    EXPECT_EQ(end.at, Vec3(3.5, 1.8, 0)) << "beyond its end";
    EXPECT_NEAR(end.distance2, 1 + 4 + 0.25, 1e-14);
}

TEST(Foot, StaysOnItsCurve) {
    Pieces p = line();
    p.g.curves.push_back(p.g.curves[0]);
    p.g.segments[2].shape = p.g.segments[3].shape = 1;
    const Foot foot = curve_foot(p.g, on_curve, Vec3(4, 3, 0));
    EXPECT_EQ(foot.piece, 1);
    EXPECT_LT((foot.at - Vec3(2, 0.3, 0)).norm(), 1e-15);
}

TEST(Foot, OfAStraightLineIsBeyondItsSegments) {
    Pieces p = line();
    p.g.curves[0] = {.straight = true, .origin = Vec3(0, 0, 1), .direction = Vec3::UnitX()};
    const Foot foot = curve_foot(p.g, on_curve, Vec3(70, 3, 5));
    EXPECT_EQ(foot.at, Vec3(70, 0, 1));
    EXPECT_EQ(foot.normal, Vec3::UnitX());
    EXPECT_NEAR(foot.distance2, 25, 1e-13);
}

TEST(Foot, OfASecondOrderSegmentIsOnTheArc) {
    Pieces p({{-1, 1, 0}, {1, 1, 0}});
    p.add_segment(0, 1);
    KeptGeometry::Segment& s = p.g.segments[0];
    s.mid = Vec3::Zero();  // y = x^2
    s.curved = true;
    for (const double x : {-0.7, -0.2, 0.0, 0.5}) {
        const Vec3 on(x, x * x, 0), tangent = Vec3(1, 2 * x, 0).normalized(), normal(-tangent[1], tangent[0], 0);
        const Foot foot = foot_on(s, on - 0.2 * normal + 0.1 * Vec3::UnitZ());
        EXPECT_LT((foot.at - on).norm(), 1e-6) << x;
        EXPECT_NEAR(std::abs(foot.normal.dot(tangent)), 1, 1e-11);
        EXPECT_NEAR(foot.distance2, 0.05, 1e-11);
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
