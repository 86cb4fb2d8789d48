// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/planar_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace femscalpel {
namespace FILE_NAMESPACE {

double area_of(const std::vector<Vec2>& p, const Triangle& t) {
    const Vec2 u = p[t[1]] - p[t[0]], v = p[t[2]] - p[t[0]];
    return (u.x() * v.y() - u.y() * v.x()) / 2;
}

double shape_of(const std::vector<Vec2>& p, const Triangle& t) {
    double squares = 0;
    for (int k = 0; k < 3; ++k) squares += (p[t[k]] - p[t[(k + 1) % 3]]).squaredNorm();
    return 4 * std::sqrt(3.0) * area_of(p, t) / squares;
}

/// Smallest shape; checks that areas are positive and add up, and that the outline is as it was.
double check(const std::vector<Vec2>& polygon, double spacing) {
    std::vector<Vec2> points = polygon;
    const std::vector<Vec2> inside = points_inside(polygon, spacing);
    points.insert(points.end(), inside.begin(), inside.end());
    const std::vector<Triangle> triangles = triangulate(polygon, inside);
    smooth(points, polygon.size(), triangles, 5);
    double total = 0, worst = 1;
    std::map<std::pair<int, int>, int> edges;
    for (const Triangle& t : triangles) {
        EXPECT_GT(area_of(points, t), 0);
        total += area_of(points, t);
        worst = std::min(worst, shape_of(points, t));
        for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    }
    EXPECT_NEAR(total, polygon_area(polygon), 1e-12 * total);
    const int n = static_cast<int>(polygon.size());
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        const bool outline = edge.first < n && edge.second == (edge.first + 1) % n;
        EXPECT_EQ(edges.contains({edge.second, edge.first}), !outline);
    }
    for (int k = 0; k < n; ++k) EXPECT_TRUE(edges.contains({k, (k + 1) % n}));
    return worst;
}

void add_line(std::vector<Vec2>& polygon, const Vec2& from, const Vec2& to, int parts) {
    for (int k = 0; k < parts; ++k) polygon.push_back(from + (to - from) * k / parts);
}

TEST(PlanarMesh, Rectangle) {
    std::vector<Vec2> polygon;
    add_line(polygon, {0, 0}, {10, 0}, 10);
    add_line(polygon, {10, 0}, {10, 4}, 4);
    add_line(polygon, {10, 4}, {0, 4}, 12);
    add_line(polygon, {0, 4}, {0, 0}, 4);
    EXPECT_GT(check(polygon, 1), 0.6);
    EXPECT_GT(check(polygon, 100), 0.05) << "no points inside";
}

TEST(PlanarMesh, QuarterCircleInACorner) {
    std::vector<Vec2> polygon;  // concave
    add_line(polygon, {0, 0}, {2, 0}, 4);
    add_line(polygon, {2, 0}, {2, 1}, 2);
    for (int k = 0; k < 8; ++k) {
        const double a = 1.5 * M_PI - k * M_PI / 16;
        polygon.emplace_back(2 + std::cos(a), 2 + std::sin(a));
    }
    add_line(polygon, {1, 2}, {0, 2}, 2);
    add_line(polygon, {0, 2}, {0, 0}, 4);
    EXPECT_GT(check(polygon, 0.4), 0.4);
}

TEST(PlanarMesh, OutlineThatCrossesItselfIsRefused) {
    EXPECT_THROW(triangulate(std::vector<Vec2>{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}), QualityError);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
