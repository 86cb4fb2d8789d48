// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/front.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace femscalpel {
namespace {

/// Slopes of the cubic spline through points at distances `lengths`, whose second derivative is continuous; at open
/// ends it is that of the next point, so that arcs of circles stay round.
std::vector<Vec3> spline_slopes(const std::vector<Vec3>& points, const std::vector<double>& lengths, bool closed) {
    const auto n = static_cast<int>(points.size()) - (closed ? 1 : 0);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(n, 3);
    const auto chord = [&](int k) -> Vec3 { return (points[k + 1] - points[k]) / lengths[k]; };
    for (int k = 0; k < n; ++k) {
        const bool first = k == 0 && !closed, last = k == n - 1 && !closed;
        if (first || last) {
            if (n == 2) {
                entries.emplace_back(k, k, 1);
                right.row(k) = chord(0);
                continue;
            }
            // Through three points: m0 + m1 = 2 chord where the third derivative is nothing.
            entries.emplace_back(k, k, 1);
            entries.emplace_back(k, first ? 1 : n - 2, 1);
            right.row(k) = 2 * chord(first ? 0 : n - 2);
            continue;
        }
        const int before = k == 0 ? n - 1 : k - 1;
        const double l = lengths[before], r = lengths[k];
        entries.emplace_back(k, before, r);
        entries.emplace_back(k, k, 2 * (l + r));
        entries.emplace_back(k, (k + 1) % n, l);
        right.row(k) = 3 * (r * chord(before) + l * chord(k));
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::MatrixX3d solved = solver.solve(right);
    std::vector<Vec3> out(points.size());
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = solved.row(static_cast<int>(k) % n);
    return out;
}

Vec3 square_to(const Vec3& v, const Vec3& unit) { return (v - v.dot(unit) * unit).normalized(); }

}  // namespace

CrackFront::CrackFront(std::vector<Vec3> points, const std::vector<Vec3>& ahead, const std::vector<Vec3>& normals)
    : points_(std::move(points)), normals_(normals) {
    closed_ = points_.size() > 2 && points_.front() == points_.back();
    s_ = {0};
    if (points_.size() == 1) {
        slopes_ = {square_to(ahead.front(), normals_.front().normalized()).cross(normals_.front().normalized())};
        return;
    }
    const auto lengths = [&] {
        std::vector<double> out;
        for (std::size_t k = 0; k + 1 < points_.size(); ++k) out.push_back((points_[k + 1] - points_[k]).norm());
        return out;
    };
    slopes_ = spline_slopes(points_, lengths(), closed_);
    double turn = 0;
    for (std::size_t k = 0; k < points_.size(); ++k) turn += normals_[k].cross(slopes_[k]).dot(ahead[k]);
    if (turn < 0) {
        std::ranges::reverse(points_);
        std::ranges::reverse(normals_);
        slopes_ = spline_slopes(points_, lengths(), closed_);
    }
    for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
        const double length = (points_[k + 1] - points_[k]).norm();
        double arc = 0;  // by three points of Gauss
        for (const auto& [u, w] : {std::pair{-std::sqrt(0.6), 5.0 / 18}, {0.0, 4.0 / 9}, {std::sqrt(0.6), 5.0 / 18}})
            arc += w * length * curve(k, length * (1 + u) / 2).first.norm();
        s_.push_back(s_.back() + arc);
    }
}

CrackFront::Curve CrackFront::curve(std::size_t piece, double u) const {
    const Vec3 &a = points_[piece], &b = points_[piece + 1], &m = slopes_[piece], &k = slopes_[piece + 1];
    const double l = (b - a).norm();
    const Vec3 chord = (b - a) / l;
    const Vec3 second = (3 * chord - 2 * m - k) / l, third = (m + k - 2 * chord) / (l * l);
    return {a + u * (m + u * (second + u * third)), m + u * (2 * second + 3 * u * third), 2 * second + 6 * u * third};
}

/// Whether the point has a foot on the piece, at `u` then; on the tangents beyond open ends, too.
bool CrackFront::is_foot(std::size_t piece, const Vec3& point, double& u) const {
    const double l = (points_[piece + 1] - points_[piece]).norm();
    const bool first = !closed_ && piece == 0, last = !closed_ && piece + 2 == points_.size();
    u = std::clamp((point - points_[piece]).dot(points_[piece + 1] - points_[piece]) / l, 0.0, l);
    for (int step = 0; step < 20; ++step) {
        Curve c = curve(piece, std::clamp(u, 0.0, l));
        if ((first && u < 0) || (last && u > l)) {
            c.at += (u - std::clamp(u, 0.0, l)) * c.first;
            c.second.setZero();
        }
        const Vec3 off = c.at - point;
        const double slope = c.first.squaredNorm() + off.dot(c.second);
        if (slope <= 0) return false;
        const double move = off.dot(c.first) / slope;
        u -= move;
        if (!first) u = std::max(u, -1e-9 * l);
        if (!last) u = std::min(u, (1 + 1e-9) * l);
        if (std::abs(move) < 1e-12 * l) break;
    }
    return true;
}

bool CrackFront::find(const Vec3& point, double reach, Place& place) const {
    if (points_.size() == 1) {
        const Vec3 n = normals_[0].normalized(), t = slopes_[0], b = n.cross(t), off = point - points_[0];
        place = {0, off.dot(b), off.dot(n), 0, {}};
        place.frame << b.transpose(), n.transpose(), t.transpose();
        return std::hypot(place.x1, place.x2) <= reach;
    }
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < points_.size(); ++k) {
        const double distance = (points_[k] - point).squaredNorm();
        if (distance < least) least = distance, nearest = k;
    }
    const std::size_t pieces = points_.size() - 1;
    bool found = false;
    double best = std::numeric_limits<double>::max();
    for (const std::size_t piece : {nearest == 0 ? pieces - 1 : nearest - 1, nearest % pieces}) {
        if (!closed_ && ((nearest == 0 && piece != 0) || (nearest == pieces && piece == 0 && pieces > 1))) continue;
        double u = 0;
        if (!is_foot(piece, point, u)) continue;
        const double l = (points_[piece + 1] - points_[piece]).norm(), inside = std::clamp(u, 0.0, l);
        const Curve c = curve(piece, inside);
        const Vec3 t = c.first.normalized();
        const Vec3 n = square_to(((l - inside) * normals_[piece] + inside * normals_[piece + 1]) / l, t),
                   b = n.cross(t);
        const Vec3 off = point - c.at - (u - inside) * c.first;
        const double x1 = off.dot(b), x2 = off.dot(n);
        if (off.squaredNorm() >= best) continue;
        best = off.squaredNorm();
        const Vec3 bend = (c.second - c.second.dot(t) * t) / c.first.squaredNorm();
        const double share = inside / l;
        place.s = s_[piece] + share * (s_[piece + 1] - s_[piece]) + (u - inside) * c.first.norm();
        place.x1 = x1;
        place.x2 = x2;
        place.curvature = u == inside ? -b.dot(bend) : 0;
        place.frame << b.transpose(), n.transpose(), t.transpose();
        found = std::hypot(x1, x2) <= reach;
    }
    return found;
}

double CrackFront::along(double s, double t) const {
    const double way = t - s;
    return closed_ ? way - length() * std::round(way / length()) : way;
}

}  // namespace femscalpel
