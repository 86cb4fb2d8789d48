// SPDX-License-Identifier: LGPL-2.1-or-later
#include "distances_by_hand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "elements_by_hand.h"

namespace femscalpel::checks {
namespace {

/// Distance of a point to a flat triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double distance_to(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d1 <= 0 && d2 <= 0) return ap.norm();
    if (d3 >= 0 && d4 <= d3) return bp.norm();
    if (d6 >= 0 && d5 <= d6) return cp.norm();
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).norm();
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).norm();
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return (bp - (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b)).norm();
    const double sum = va + vb + vc;
    return (ap - vb / sum * ab - vc / sum * ac).norm();
}

/// Distance to a three-node segment, as 64 straight pieces: their sagitta is 1/4096 of its own.
double distance_to_arc(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& mid) {
    double best = std::numeric_limits<double>::infinity();
    Vec3 from = a;
    for (int k = 1; k <= 64; ++k) {
        const double x = k / 32.0 - 1;
        const Vec3 to = x * (x - 1) / 2 * a + x * (x + 1) / 2 * b + (1 - x * x) * mid;
        const double t = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
        best = std::min(best, (p - from - t * (to - from)).norm());
        from = to;
    }
    return best;
}

double distance_to(const Vec3& p, const Model::Face& f) {
    if (!f.curved) return distance_to(p, f.corner[0], f.corner[1], f.corner[2]);
    // Gauss-Newton from the nearest of a few points, kept inside the triangle.
    double best = std::numeric_limits<double>::infinity(), u = 0, v = 0;
    for (int i = 0; i <= 4; ++i)
        for (int j = 0; i + j <= 4; ++j)
            if (const double d = (on_face(f.corner, f.mid, i / 4.0, j / 4.0).at - p).norm(); d < best) {
                best = d;
                u = i / 4.0;
                v = j / 4.0;
            }
    for (int round = 0; round < 30; ++round) {
        const OnFace x = on_face(f.corner, f.mid, u, v);
        const Vec3 r = p - x.at;
        best = std::min(best, r.norm());
        const double a = x.du.dot(x.du), b = x.du.dot(x.dv), c = x.dv.dot(x.dv), e = x.du.dot(r), g = x.dv.dot(r);
        const double determinant = a * c - b * b;
        double next_u = u + (c * e - b * g) / determinant, next_v = v + (a * g - b * e) / determinant;
        next_u = std::clamp(next_u, 0.0, 1.0);
        next_v = std::clamp(next_v, 0.0, 1.0);
        if (const double over = next_u + next_v - 1; over > 0) {
            next_u = std::clamp(next_u - over / 2, 0.0, 1.0);
            next_v = 1 - next_u;
        }
        if (std::abs(next_u - u) + std::abs(next_v - v) < 1e-12) break;
        u = next_u;
        v = next_v;
    }
    // The steps may stop short on the triangle's own edges, where feet of points beside a seam are.
    for (int k = 0; k < 3; ++k) best = std::min(best, distance_to_arc(p, f.corner[k], f.corner[(k + 1) % 3], f.mid[k]));
    return best;
}

}  // namespace

double edges_away(const Vec3& p, const std::vector<Model::Face>& faces, double limit) {
    double best = limit;
    for (const Model::Face& f : faces) {
        if ((p - f.centre).norm() - f.radius > best * f.edge) continue;
        best = std::min(best, distance_to(p, f) / f.edge);
    }
    return best;
}

double distance_away(const Vec3& p, const std::vector<Model::Face>& faces) {
    double best = std::numeric_limits<double>::infinity();
    for (const Model::Face& f : faces)
        if ((p - f.centre).norm() - f.radius < best) best = std::min(best, distance_to(p, f));
    return best;
}

double distance_away(const Vec3& p, const std::vector<Model::Segment>& segments) {
    double best = std::numeric_limits<double>::infinity();
    for (const Model::Segment& s : segments) best = std::min(best, distance_to_arc(p, s.end[0], s.end[1], s.mid));
    return best;
}

double edges_away(const Vec3& p, const std::vector<Model::Segment>& segments, double limit) {
    double best = limit;
    for (const Model::Segment& s : segments) {
        const double length = (s.end[1] - s.end[0]).norm();
        const Vec3 middle = (s.end[0] + s.end[1]) / 2;
        if ((p - middle).norm() > length + best * length) continue;
        best = std::min(best, distance_to_arc(p, s.end[0], s.end[1], s.mid) / length);
    }
    return best;
}

}  // namespace femscalpel::checks
