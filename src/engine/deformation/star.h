// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "deformation/deformable.h"
#include "mesh/quality.h"

namespace femscalpel {

/// One element as a function of the position x of one of its corners:
/// 1 / mean ratio = S(x) / (c M(x)^e), S the sum of squared edges, M volume or area, linear in x.
struct Term {
    Vec3 gradient;    // of M
    double offset;    // M = gradient.x + offset
    Vec3 corner_sum;  // of the other corners
    double constant;  // S = edges |x|^2 - 2 x.corner_sum + constant
    double edges;     // 3 or 2
    double exponent;  // 2/3 or 1
    double scale;     // 1 / c

    double inverse_quality(const Vec3& x) const {
        const double measure = gradient.dot(x) + offset;
        if (!(measure > 0)) return std::numeric_limits<double>::infinity();
        const double squares = edges * x.squaredNorm() - 2 * x.dot(corner_sum) + constant;
        if (exponent == 1) return scale * squares / measure;
        const double root = inverse_cube_root(measure);
        return scale * squares * root * root;
    }
};

/// The elements around one node, relative to the node's own position for accuracy.
class Star {
public:
    void gather(const Deformable& d, int node) {
        terms_.clear();
        const BandMesh& band = d.band;
        origin_ = band.nodes[node].at;
        static const double tetra_scale = 1 / (12 * std::cbrt(9.0));
        static const double shell_scale = 1 / (4 * std::sqrt(3.0));
        for (const int t : band.tetras.around(node)) {
            const auto& v = band.tetras[t];
            const int k = static_cast<int>(std::ranges::find(v, node) - v.begin());
            const Vec3 a = band.nodes[v[opposite_face[k][0]]].at - origin_;
            const Vec3 b = band.nodes[v[opposite_face[k][1]]].at - origin_;
            const Vec3 c = band.nodes[v[opposite_face[k][2]]].at - origin_;
            Term term;
            term.gradient = (b - a).cross(c - a) / 6;
            term.offset = -term.gradient.dot(a);
            term.corner_sum = a + b + c;
            term.constant = a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + (b - a).squaredNorm() +
                            (c - a).squaredNorm() + (c - b).squaredNorm();
            term.edges = 3;
            term.exponent = 2.0 / 3;
            term.scale = tetra_scale;
            terms_.push_back(term);
        }
        for (const int t : band.triangles.around(node)) {
            const int origin = band.triangles.origin(t);
            if (!d.constraints.is_shell(origin)) continue;
            const auto& v = band.triangles[t];
            const int k = static_cast<int>(std::ranges::find(v, node) - v.begin());
            const Vec3 a = band.nodes[v[(k + 1) % 3]].at - origin_;
            const Vec3 b = band.nodes[v[(k + 2) % 3]].at - origin_;
            Term term;
            term.gradient = d.shell_normals[origin].cross(b - a) / 2;
            term.offset = -term.gradient.dot(a);
            term.corner_sum = a + b;
            term.constant = a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm();
            term.edges = 2;
            term.exponent = 1;
            term.scale = shell_scale;
            terms_.push_back(term);
        }
    }

    bool empty() const { return terms_.empty(); }

    double worst(const Vec3& x) const {
        double largest = 0;
        const Vec3 y = x - origin_;
        for (const Term& t : terms_) largest = std::max(largest, t.inverse_quality(y));
        return 1 / largest;
    }

    double value(const Vec3& x, int doublings) const {
        double sum = 0;
        const Vec3 y = x - origin_;
        for (const Term& t : terms_) sum += power(t.inverse_quality(y), doublings);
        return sum;
    }

    double derivatives(const Vec3& x, int doublings, Vec3& gradient, Eigen::Matrix3d& hessian) const {
        gradient.setZero();
        hessian.setZero();
        const Vec3 y = x - origin_;
        const double p = 1 << doublings;
        double sum = 0;
        for (const Term& t : terms_) {
            const double measure = t.gradient.dot(y) + t.offset;
            if (!(measure > 0)) return std::numeric_limits<double>::infinity();
            const double squares = t.edges * y.squaredNorm() - 2 * y.dot(t.corner_sum) + t.constant;
            const Vec3 grad_squares = 2 * (t.edges * y - t.corner_sum);
            const double u = power(t.inverse_quality(y), doublings);
            const Vec3 squares_part = grad_squares / squares;
            const Vec3 measure_part = t.gradient / measure;
            const Vec3 log_gradient = squares_part - t.exponent * measure_part;
            sum += u;
            gradient += p * u * log_gradient;
            hessian += p * u *
                       (p * log_gradient * log_gradient.transpose() - squares_part * squares_part.transpose() +
                        t.exponent * measure_part * measure_part.transpose());
            hessian.diagonal().array() += p * u * 2 * t.edges / squares;
        }
        return sum;
    }

private:
    static double power(double u, int doublings) {
        for (int k = 0; k < doublings; ++k) u *= u;
        return u;
    }
    std::vector<Term> terms_;
    Vec3 origin_ = Vec3::Zero();
};

}  // namespace femscalpel
