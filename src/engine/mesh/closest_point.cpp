// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/closest_point.h"

#include <algorithm>

namespace femscalpel {

Vec3 closest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, Vec3& bary) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return bary = {1, 0, 0}, a;
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return bary = {0, 1, 0}, b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double v = d1 / (d1 - d3);
        return bary = {1 - v, v, 0}, a + v * ab;
    }
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return bary = {0, 0, 1}, c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double w = d2 / (d2 - d6);
        return bary = {1 - w, 0, w}, a + w * ac;
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return bary = {0, 1 - w, w}, b + w * (c - b);
    }
    const double denominator = 1 / (va + vb + vc);
    const double v = vb * denominator, w = vc * denominator;
    bary = {1 - v - w, v, w};
    return a + ab * v + ac * w;
}

Vec3 closest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
    const Vec3 along = b - a;
    const double length2 = along.squaredNorm();
    return length2 > 0 ? Vec3(a + std::clamp(along.dot(p - a) / length2, 0.0, 1.0) * along) : a;
}

}  // namespace femscalpel
