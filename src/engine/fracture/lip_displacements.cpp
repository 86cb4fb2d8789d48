// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/lip_displacements.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace femscalpel {
namespace {

/// A pair of nodes that lay on each other, and what would be K there.
struct Pair {
    double s, r;
    Eigen::Vector3d k;
};

std::vector<Pair> pairs_behind(const Mesh& mesh, std::span<const Vec3> displacements, const CrackLips& lips,
                               const CrackFront& front, double radius, const Elasticity& elasticity) {
    const auto place_of = [](const Vec3& p) { return std::array{p.x(), p.y(), p.z()}; };
    std::map<std::array<double, 3>, Index> negative;
    for (Index v = 0; v < mesh.node_count(); ++v)
        if (lips.negative[v] && !lips.positive[v]) negative.emplace(place_of(mesh.points[v]), v);
    std::vector<Pair> out;
    CrackFront::Place at;
    const double mu = elasticity.shear();
    for (Index v = 0; v < mesh.node_count(); ++v) {
        if (!lips.positive[v] || lips.negative[v] || !front.find(mesh.points[v], radius, at) || at.x1 >= 0) continue;
        const auto partner = negative.find(place_of(mesh.points[v]));
        if (partner == negative.end()) continue;
        const Vec3 apart = at.frame * (displacements[v] - displacements[partner->second]);
        const double r = std::hypot(at.x1, at.x2), root = std::sqrt(2 * std::numbers::pi / r);
        const double plane = mu / (elasticity.kappa() + 1) * root;
        out.push_back({at.s, r, {plane * apart[1], plane * apart[0], mu / 4 * root * apart[2]}});
    }
    return out;
}

}  // namespace

std::vector<std::array<double, 3>> lip_displacements(const Mesh& mesh, std::span<const Vec3> displacements,
                                                     const CrackLips& lips, const CrackFront& front,
                                                     const std::vector<double>& places, double radius, double along,
                                                     const Elasticity& elasticity) {
    const std::vector<Pair> pairs = pairs_behind(mesh, displacements, lips, front, radius, elasticity);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::array<double, 3>> out(places.size(), {none, none, none});
    for (std::size_t k = 0; k < places.size(); ++k) {
        // The straight line through K over r, by least squares.
        Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
        Eigen::Matrix<double, 2, 3> right = Eigen::Matrix<double, 2, 3>::Zero();
        int count = 0;
        for (const Pair& pair : pairs) {
            if (front.length() > 0 && std::abs(front.along(places[k], pair.s)) > along) continue;
            const Eigen::Vector2d row(1, pair.r / radius);
            matrix += row * row.transpose();
            right += row * pair.k.transpose();
            ++count;
        }
        if (count < 3 || std::abs(matrix.determinant()) < 1e-6 * count * count) continue;
        const Eigen::Vector3d at_front = matrix.inverse().row(0) * right;
        out[k] = {at_front[0], at_front[1], at_front[2]};
    }
    return out;
}

}  // namespace femscalpel
