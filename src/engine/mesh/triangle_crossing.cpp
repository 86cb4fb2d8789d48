// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/triangle_crossing.h"

#include <algorithm>
#include <cmath>

namespace femscalpel {
namespace {

/// Sine of the angle below which two triangles do not cross but lie in one plane.
constexpr double nearly_parallel = 0.03;

/// Where a triangle crosses a plane, of which its vertices are so far; nothing if in less than a segment, or all of it.
std::optional<Span> cross_plane(const TriangleCorners& t, std::array<double, 3> off, double tolerance) {
    std::array<Vec3, 6> found;
    std::size_t count = 0;
    for (double& d : off)
        if (std::abs(d) <= tolerance) d = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (off[k] == 0) found[count++] = t[k];
    if (count == 3) return {};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        if (off[k] * off[l] < 0) found[count++] = t[k] + off[k] / (off[k] - off[l]) * (t[l] - t[k]);
    }
    if (count != 2) return {};
    return Span{found[0], found[1]};
}

}  // namespace

std::optional<Span> cross_triangles(const TriangleCorners& a, const TriangleCorners& b, double tolerance) {
    const Vec3 na = (a[1] - a[0]).cross(a[2] - a[0]).normalized(), nb = (b[1] - b[0]).cross(b[2] - b[0]).normalized();
    const Vec3 along = na.cross(nb);
    if (along.norm() < nearly_parallel) return {};
    std::array<double, 3> off_a{}, off_b{};
    for (std::size_t k = 0; k < 3; ++k) {
        off_a[k] = nb.dot(a[k] - b[0]);
        off_b[k] = na.dot(b[k] - a[0]);
    }
    const auto of_a = cross_plane(a, off_a, tolerance), of_b = cross_plane(b, off_b, tolerance);
    if (!of_a || !of_b) return {};
    const Vec3 direction = along.normalized();
    const auto ordered = [&](Span s) {
        if (direction.dot(s[1] - s[0]) < 0) std::swap(s[0], s[1]);
        return s;
    };
    const Span p = ordered(*of_a), q = ordered(*of_b);
    // A node of b has the say where one of a is not nearer to the end of what both have.
    const Vec3 low = direction.dot(p[0] - q[0]) > tolerance ? p[0] : q[0];
    const Vec3 high = direction.dot(p[1] - q[1]) < -tolerance ? p[1] : q[1];
    if (direction.dot(high - low) <= tolerance) return {};
    // Spans of planes that are but tolerance apart at the vertices may miss each other sideways.
    for (const Vec3& x : {low, high})
        for (const Span& s : {p, q}) {
            const Vec3 way = s[1] - s[0];
            const double t = std::clamp((x - s[0]).dot(way) / way.squaredNorm(), 0.0, 1.0);
            if ((s[0] + t * way - x).norm() > 4 * tolerance) return {};
        }
    return Span{low, high};
}

}  // namespace femscalpel
