// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/untangler.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "cancel.h"

namespace femscalpel {
namespace {

/// See untangle().
class Untangler {
public:
    explicit Untangler(Deformable& d) : d_(d), band_(d.band) {
        for (int t = 0; t < band_.tetras.size(); ++t) tetra_volume_.push_back(regular_measure(band_.tetras[t]));
        for (int t = 0; t < band_.triangles.size(); ++t) shell_area_.push_back(regular_measure(band_.triangles[t]));
    }

    /// The worst quality reached.
    double run(const std::vector<int>& movable, double goal) {
        std::vector<char> may_move(static_cast<std::size_t>(band_.size()), 0);
        for (const int v : movable) may_move[v] = 1;
        double worst = 0;
        for (double delta = 0.5; delta > 0.004; delta /= 2)
            for (int sweep = 0; sweep < 4; ++sweep) {
                std::vector<char> chosen(may_move.size(), 0);
                worst = choose(goal, chosen);
                if (worst >= goal) return worst;
                for (const int v : movable) {
                    check_cancelled();
                    if (chosen[v]) improve(v, delta);
                }
            }
        return worst;
    }

private:
    struct Term {
        Vec3 gradient;  // of the measure (volume or area) by the node's position
        double offset;
        Vec3 corner_sum;
        double constant;  // squared edges = edges |x|^2 - 2 x.corner_sum + constant
        double edges;
        double exponent;
        double delta;
        double scale;
    };

    template <std::size_t N>
    double regular_measure(const std::array<int, N>& v) const {
        double squares = 0;
        for (std::size_t i = 0; i < N; ++i)
            for (std::size_t j = 0; j < i; ++j)
                squares += (band_.nodes[v[i]].start - band_.nodes[v[j]].start).squaredNorm();
        const double square = squares / (N * (N - 1) / 2.0);
        return N == 4 ? square * std::sqrt(square) / (6 * std::sqrt(2.0)) : square * std::sqrt(3.0) / 4;
    }

    /// Marks the nodes of bad elements and their neighbours.
    double choose(double goal, std::vector<char>& chosen) const {
        double worst = 1;
        std::vector<int> seeds;
        check_cancelled();
        const auto look = [&](const auto& v, double quality) {
            worst = std::min(worst, quality);
            if (quality < goal) seeds.insert(seeds.end(), v.begin(), v.end());
        };
        for (int t = 0; t < band_.tetras.size(); ++t) look(band_.tetras[t], tetra_quality(d_, t));
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (d_.constraints.is_shell(band_.triangles.origin(t))) look(band_.triangles[t], shell_quality(d_, t));
        for (const int v : seeds) {
            for (const int s : band_.tetras.around(v))
                for (const int w : band_.tetras[s]) chosen[w] = 1;
            for (const int s : band_.triangles.around(v))
                for (const int w : band_.triangles[s]) chosen[w] = 1;
        }
        return worst;
    }

    void gather(int node, double delta) {
        terms_.clear();
        const Vec3 origin = band_.nodes[node].at;
        for (const int t : band_.tetras.around(node)) {
            const auto& v = band_.tetras[t];
            const int k = static_cast<int>(std::ranges::find(v, node) - v.begin());
            const Vec3 a = band_.nodes[v[opposite_face[k][0]]].at - origin,
                       b = band_.nodes[v[opposite_face[k][1]]].at - origin,
                       c = band_.nodes[v[opposite_face[k][2]]].at - origin;
            const Vec3 gradient = (b - a).cross(c - a) / 6;
            terms_.push_back({gradient, -gradient.dot(a), a + b + c,
                              a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + (b - a).squaredNorm() +
                                  (c - a).squaredNorm() + (c - b).squaredNorm(),
                              3, 2.0 / 3, delta * tetra_volume_[t], 1 / (12 * std::cbrt(9.0))});
        }
        for (const int t : band_.triangles.around(node)) {
            if (!d_.constraints.is_shell(band_.triangles.origin(t))) continue;
            const auto& v = band_.triangles[t];
            const int k = static_cast<int>(std::ranges::find(v, node) - v.begin());
            const Vec3 a = band_.nodes[v[(k + 1) % 3]].at - origin, b = band_.nodes[v[(k + 2) % 3]].at - origin;
            const Vec3 gradient = d_.shell_normals[band_.triangles.origin(t)].cross(b - a) / 2;
            terms_.push_back({gradient, -gradient.dot(a), a + b,
                              a.squaredNorm() + b.squaredNorm() + (b - a).squaredNorm(), 2, 1, delta * shell_area_[t],
                              1 / (4 * std::sqrt(3.0))});
        }
    }

    /// Objective at the node's position plus y, with derivatives if asked for.
    double value(const Vec3& y, Vec3* gradient, Eigen::Matrix3d* hessian) const {
        double sum = 0;
        if (gradient) {
            gradient->setZero();
            hessian->setZero();
        }
        for (const Term& t : terms_) {
            const double measure = t.gradient.dot(y) + t.offset;
            const double root = std::sqrt(measure * measure + 4 * t.delta * t.delta);
            // Of the two equal forms the one without cancellation.
            const double positive = measure > 0 ? (measure + root) / 2 : 2 * t.delta * t.delta / (root - measure);
            const double squares = t.edges * y.squaredNorm() - 2 * y.dot(t.corner_sum) + t.constant;
            const double u = t.scale * squares / std::pow(positive, t.exponent);
            const double power = u * u;
            sum += power;
            if (!gradient) continue;
            const Vec3 squares_part = 2 * (t.edges * y - t.corner_sum) / squares;
            const Vec3 measure_part = t.gradient / root;
            const Vec3 log_gradient = squares_part - t.exponent * measure_part;
            *gradient += 2 * power * log_gradient;
            *hessian += 2 * power *
                        (2 * log_gradient * log_gradient.transpose() - squares_part * squares_part.transpose() +
                         t.exponent * std::max(0.0, measure / root) * measure_part * measure_part.transpose());
            hessian->diagonal().array() += 2 * power * 2 * t.edges / squares;
        }
        return sum;
    }

    void improve(int v, double delta) {
        BandNode& node = band_.nodes[v];
        Eigen::Matrix3d basis;
        const int freedom = d_.constraints.tangents(v, d_.contact[v], node.at, basis);
        if (freedom == 0) return;
        gather(v, delta);
        const auto tangent = basis.leftCols(freedom);
        const Vec3 origin = node.at;
        const double limit = 0.5 * band_.mean_edge_length(v);
        Vec3 gradient;
        Eigen::Matrix3d hessian;
        for (int iteration = 0; iteration < 2; ++iteration) {
            const double now = value(node.at - origin, &gradient, &hessian);
            using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
            Small h = tangent.transpose() * hessian * tangent;
            Eigen::LDLT<Small> factors(h);
            if (factors.info() != Eigen::Success || !factors.isPositive()) {
                h.diagonal().array() += h.norm();
                factors.compute(h);
            }
            const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> g = tangent.transpose() * gradient;
            Vec3 step = -(tangent * factors.solve(g));
            if (!step.allFinite()) return;
            if (step.norm() > limit) step *= limit / step.norm();
            bool accepted = false;
            for (int halving = 0; halving < 6 && !accepted; ++halving, step /= 2) {
                Vec3 x = node.at + step;
                if (!d_.constraints.project(v, d_.contact[v], x) || d_.is_barred(v, x) ||
                    !(value(x - origin, nullptr, nullptr) < now))
                    continue;
                node.at = x;
                accepted = true;
            }
            if (!accepted) return;
        }
    }

    Deformable& d_;
    BandMesh& band_;
    std::vector<double> tetra_volume_, shell_area_;
    std::vector<Term> terms_;
};

}  // namespace

double untangle(Deformable& d, const std::vector<int>& movable, double goal) { return Untangler(d).run(movable, goal); }

}  // namespace femscalpel
