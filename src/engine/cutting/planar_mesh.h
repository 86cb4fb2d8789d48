// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "cutting/cavity.h"

namespace femscalpel {

/// A point or vector in a plane.
using Vec2 = Eigen::Vector2d;

/// Signed area of a polygon: positive when it runs counter-clockwise.
double polygon_area(std::span<const Vec2> polygon);

/// Points of a triangular grid with that spacing inside a polygon, none nearer to its outline than 0.6 of it.
std::vector<Vec2> points_inside(std::span<const Vec2> polygon, double spacing);

/// Triangles, counter-clockwise, that fill a simple polygon, given counter-clockwise, with exactly its edges as outline
/// and nodes at `inside` points; indices count the polygon's points first. Points on one line and points that are too
/// near others to be of use (these are then not in any triangle) are allowed. The triangulation is the constrained
/// Delaunay one: ears (Meisters, "Polygons have ears", Amer. Math. Monthly 82, 1975), flips (Lawson, "Software for C1
/// surface interpolation", 1977), points one by one, flips.
///
/// Throws QualityError when the polygon crosses itself.
std::vector<Triangle> triangulate(std::span<const Vec2> polygon, std::span<const Vec2> inside);

/// Moves the points of `points` from index `first` on towards the middle of their neighbours, as long as no triangle
/// turns over or gets worse than the worst around.
void smooth(std::vector<Vec2>& points, std::size_t first, std::span<const Triangle> triangles, int rounds);

}  // namespace femscalpel
