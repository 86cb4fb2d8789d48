// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/ribbon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "error.h"

namespace femscalpel {
namespace {

using Vec3 = Eigen::Vector3d;

/// Fraction of the segment a-b at which it is closest to x, and the square of the distance.
std::pair<double, double> closest(const Vec3& a, const Vec3& b, const Vec3& x) {
    const Vec3 along = b - a;
    const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return {t, (a + t * along - x).squaredNorm()};
}

/// For Eigen's BVMinimize: the segment nearest to a point.
struct Nearest {
    using Scalar = double;
    const std::vector<Vec3>& points;
    const Vec3& x;
    int segment = 0;
    double best = std::numeric_limits<double>::infinity();

    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVMinimize() calls them.
    double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return box.squaredExteriorDistance(x); }
    double minimumOnObject(int s) {
        const auto k = static_cast<std::size_t>(s);
        const double d = closest(points[k], points[k + 1 == points.size() ? 0 : k + 1], x).second;
        if (d < best) {
            best = d;
            segment = s;
        }
        return d;
    }
    // NOLINTEND(readability-identifier-naming)
};

}  // namespace

Ribbon::Ribbon(std::vector<Vec3> points, std::vector<Vec3> standing, bool closed)
    : points_(std::move(points)), standing_(std::move(standing)), closed_(closed) {
    if (points_.size() < (closed ? 3U : 2U) || standing_.size() != points_.size())
        throw ToolError("a seam needs at least two points (three if closed), each with a direction");
    arcs_.push_back(0);
    std::vector<int> segments;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (std::size_t k = 0; k + (closed ? 0 : 1) < points_.size(); ++k) {
        const double length = (points_[next(k)] - points_[k]).norm();
        if (!(length > 0)) throw ToolError("two points in a row of a seam are the same");
        arcs_.push_back(arcs_.back() + length);
        segments.push_back(static_cast<int>(k));
        boxes.emplace_back(points_[k].cwiseMin(points_[next(k)]), points_[k].cwiseMax(points_[next(k)]));
    }
    tree_.init(segments.begin(), segments.end(), boxes.begin(), boxes.end());
    // Of the circle that turns as the line does.
    feature_size_ = std::numeric_limits<double>::infinity();
    for (std::size_t k = closed ? 0 : 1; k + (closed ? 0 : 1) < points_.size(); ++k) {
        const std::size_t before = k == 0 ? points_.size() - 1 : k - 1;
        const Vec3 in = points_[k] - points_[before], out = points_[next(k)] - points_[k];
        const double turn = std::atan2(in.cross(out).norm(), in.dot(out));
        if (turn > 0.05) feature_size_ = std::min(feature_size_, (in.norm() + out.norm()) / (2 * turn));
    }
}

Vec3 Ribbon::tangent_at(std::size_t point) const {
    Vec3 sum = Vec3::Zero();
    if (point > 0 || closed_)
        sum += (points_[point] - points_[point == 0 ? points_.size() - 1 : point - 1]).normalized();
    if (point + 1 < points_.size() || closed_) sum += (points_[next(point)] - points_[point]).normalized();
    return sum.normalized();
}

Ribbon::Foot Ribbon::foot(const Vec3& x) const {
    Nearest nearest{points_, x};
    Eigen::BVMinimize(tree_, nearest);
    const auto k = static_cast<std::size_t>(nearest.segment);
    const Vec3 &a = points_[k], &b = points_[next(k)];
    const double length = arcs_[k + 1] - arcs_[k];
    double t = closest(a, b, x).first;
    const bool at_start = t == 0, at_end = t == 1;
    Foot out;
    out.tangent = (b - a) / length;
    if (!closed_ && ((at_start && k == 0) || (at_end && k + 1 == count()))) {
        t = (x - a).dot(out.tangent) / length;  // on the straight continuation
        out.at = a + t * (b - a);
    } else {
        if (at_start || at_end) out.tangent = tangent_at(at_start ? k : next(k));
        out.at = a + t * (b - a);
    }
    out.arc = arcs_[k] + t * length;
    const double s = std::clamp(t, 0.0, 1.0);
    out.standing = (1 - s) * standing_[k] + s * standing_[next(k)];
    out.standing -= out.tangent * out.tangent.dot(out.standing);
    out.standing.normalize();
    return out;
}

double Ribbon::distance(const Vec3& x) const {
    const Foot f = foot(x);
    Vec3 off = x - f.at;
    off -= f.standing * f.standing.dot(off);
    return std::copysign(off.norm(), off.dot(f.tangent.cross(f.standing)));
}

Vec3 Ribbon::normal(const Vec3& x) const {
    const Foot f = foot(x);
    Vec3 across = f.tangent.cross(f.standing).normalized();
    Vec3 off = x - f.at;
    off -= f.standing * f.standing.dot(off);
    // At the line itself, and inside of a bend where two segments are as near, rounding has the say.
    if (off.norm() < 1e-6 * length()) return across;
    return off.dot(across) < 0 ? Vec3(-off.normalized()) : Vec3(off.normalized());
}

Vec3 Ribbon::project(const Vec3& x) const {
    const Foot f = foot(x);
    return f.at + f.standing * f.standing.dot(x - f.at);
}

double Ribbon::beyond(const Vec3& x) const {
    const Foot f = foot(x);
    const double off = std::abs(f.standing.dot(x - f.at));
    return closed_ ? off : std::max({off, -f.arc, f.arc - length()});
}

Vec3 Ribbon::at(double arc) const {
    if (closed_) arc -= std::floor(arc / length()) * length();
    const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        std::ranges::upper_bound(arcs_, arc) - arcs_.begin() - 1, 0, static_cast<std::ptrdiff_t>(count()) - 1));
    const double t = std::clamp((arc - arcs_[k]) / (arcs_[k + 1] - arcs_[k]), 0.0, 1.0);
    if (t == 0) return points_[k];
    if (t == 1) return points_[next(k)];
    return points_[k] + t * (points_[next(k)] - points_[k]);
}

double Ribbon::arc_between(double from, double to) const {
    const double straight = to - from;
    return closed_ ? straight - std::round(straight / length()) * length() : straight;
}

}  // namespace femscalpel
