// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/elliptic_cylinder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace femscalpel {

EllipticCylinder::EllipticCylinder(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                                   const Eigen::Vector3d& direction, double first, double second)
    : origin_(origin), u_(direction), v_(axis.cross(direction)), a_(first), b_(second) {}

Eigen::Vector2d EllipticCylinder::local(const Eigen::Vector3d& x) const {
    return {u_.dot(x - origin_), v_.dot(x - origin_)};
}

EllipticCylinder::Foot EllipticCylinder::foot(const Eigen::Vector2d& p) const {
    // Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid" (2013): in the first quadrant,
    // the larger half axis first, the foot is (r y0 / (s + r), y1 / (s + 1)), s the only root of a convex function.
    const bool swapped = a_ < b_;
    const double e0 = swapped ? b_ : a_, e1 = swapped ? a_ : b_;
    const double y0 = std::abs(swapped ? p[1] : p[0]), y1 = std::abs(swapped ? p[0] : p[1]);
    double x0, x1;
    if (y1 > 0) {
        const double z0 = y0 / e0, z1 = y1 / e1, r = (e0 / e1) * (e0 / e1);
        double low = z1 - 1, high = y0 > 0 ? std::hypot(r * z0, z1) - 1 : low, s = low;
        for (int i = 0; i < 200; ++i) {
            s = (low + high) / 2;
            if (s == low || s == high) break;
            const double f0 = r * z0 / (s + r), f1 = z1 / (s + 1), g = f0 * f0 + f1 * f1 - 1;
            if (g == 0) break;
            (g > 0 ? low : high) = s;
        }
        x0 = r * y0 / (s + r);
        x1 = y1 / (s + 1);
    } else {
        const double reach = e0 * e0 - e1 * e1;
        if (e0 * y0 < reach) {
            const double c = e0 * y0 / reach;
            x0 = e0 * c;
            x1 = e1 * std::sqrt(std::max(0.0, 1 - c * c));
        } else {
            x0 = e0;
            x1 = 0;
        }
    }
    Foot out;
    out.at = swapped ? Eigen::Vector2d(std::copysign(x1, p[0]), std::copysign(x0, p[1]))
                     : Eigen::Vector2d(std::copysign(x0, p[0]), std::copysign(x1, p[1]));
    const bool outside = (p[0] / a_) * (p[0] / a_) + (p[1] / b_) * (p[1] / b_) > 1;
    out.distance = (outside ? 1 : -1) * (p - out.at).norm();
    return out;
}

double EllipticCylinder::distance(const Eigen::Vector3d& x) const { return foot(local(x)).distance; }

Eigen::Vector3d EllipticCylinder::normal(const Eigen::Vector3d& x) const {
    // The gradient of the implicit equation at the foot: sound on the ellipse itself too.
    const Eigen::Vector2d f = foot(local(x)).at;
    const Eigen::Vector2d n = Eigen::Vector2d(f[0] / (a_ * a_), f[1] / (b_ * b_)).normalized();
    return n[0] * u_ + n[1] * v_;
}

double EllipticCylinder::feature_size() const { return std::min(a_ * a_ / b_, b_ * b_ / a_); }

}  // namespace femscalpel
