// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/interaction_integral.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "fracture/quadrature.h"

namespace femscalpel {
namespace {

/// From 1 within `inner` to 0 beyond `outer`, and its slope.
std::array<double, 2> plateau(double r, const IntegralDomain& domain) {
    if (r <= domain.inner) return {1, 0};
    if (r >= domain.outer) return {0, 0};
    const double width = domain.outer - domain.inner, u = (r - domain.inner) / width;
    return {1 - u * u * (3 - 2 * u), -6 * u * (1 - u) / width};
}

/// From 1 at no distance to 0 at `along`, and its slope.
std::array<double, 2> hat(double distance, double along) {
    if (std::abs(distance) >= along) return {0, 0};
    const double angle = std::numbers::pi * distance / along;
    return {(1 + std::cos(angle)) / 2, -std::numbers::pi / (2 * along) * std::sin(angle)};
}

/// What a point of integration gives in one mode: its part that goes with the virtual growth's share along the front,
/// and the part that goes with that share's slope.
struct Contribution {
    double level = 0, slope = 0;
};

Contribution contribution(const AuxiliaryField& auxiliary, const Eigen::Matrix3d& gradient, const CrackFront::Place& at,
                          double r, const std::array<double, 2>& growth, const Elasticity& elasticity) {
    const Eigen::Matrix3d stress = elasticity.stress((gradient + gradient.transpose()) / 2);
    const double bend = at.curvature / (1 + at.curvature * at.x1);  // of the lines beside the front
    const Eigen::Matrix3d& extra = auxiliary.stress;
    const Vec3& u = auxiliary.displacement;
    Eigen::Matrix3d slopes = auxiliary.gradient;
    slopes(0, 2) -= bend * u[2];
    slopes(2, 2) += bend * u[0];
    const double work = stress.cwiseProduct(elasticity.strain(extra)).sum();
    Eigen::Matrix3d flow = work * Eigen::Matrix3d::Identity();
    flow -= slopes.transpose() * stress + gradient.transpose() * extra;

    const auto [level, fall] = growth;
    Contribution out;
    out.level = -(flow(0, 0) * at.x1 + flow(0, 1) * at.x2) / r * fall - flow(2, 2) * bend * level;
    out.slope = -flow(0, 2) * level / (1 + at.curvature * at.x1);
    const double by_1 = bend * slopes(0, 0) - bend * bend * u[0], by_3 = bend * slopes(2, 0) - bend * bend * u[2];
    const Vec3 unbalanced = bend * Vec3(extra(0, 0) - extra(2, 2), extra(0, 1), 2 * extra(0, 2));
    out.level += level * (stress(2, 2) * by_1 - stress(0, 2) * by_3 + unbalanced.dot(gradient.col(0)));
    return out;
}

/// Integral of hat() over the front around one of its places.
double width_at(const CrackFront& front, double place, double along) {
    if (front.length() == 0) return 1;
    if (front.closed()) return along;
    const auto part = [&](double end) {  // of the hat from its middle to a distance
        const double d = std::min(end, along);
        return d / 2 + along / (2 * std::numbers::pi) * std::sin(std::numbers::pi * d / along);
    };
    return part(place) + part(front.length() - place);
}

/// By the nodes of one element.
struct ElementState {
    Eigen::Matrix3Xd places, displacements;
};

/// Gradient of the displacements in the front's frame, and the element's measure at the point; of shells in the plane
/// of b and n. The measure is 0 where the element is of no size.
double local_gradient(const ElementState& element, const QuadraturePoint& point, const Eigen::Matrix3d& frame,
                      Eigen::Matrix3d& gradient) {
    const Eigen::Index dimension = point.derivatives.cols();
    const Eigen::MatrixXd to_place = (frame * element.places * point.derivatives).topRows(dimension);
    const Eigen::MatrixXd slopes = (frame * element.displacements * point.derivatives).topRows(dimension);
    const double measure = std::abs(to_place.determinant());
    gradient.setZero();
    if (measure > 0) gradient.topLeftCorner(dimension, dimension) = slopes * to_place.inverse();
    return measure;
}

}  // namespace

std::vector<std::array<double, 3>> interaction_integrals(const Mesh& mesh, std::span<const Vec3> displacements,
                                                         const std::vector<CellRef>& solids, const CrackFront& front,
                                                         const std::vector<double>& places,
                                                         const IntegralDomain& domain, const Elasticity& elasticity) {
    std::vector<std::array<double, 3>> out(places.size(), {0, 0, 0});
    ElementState element;
    for (const CellRef& solid : solids) {
        const auto nodes = mesh.block(solid.type).nodes(solid.cell);
        element.places.resize(3, static_cast<Eigen::Index>(nodes.size()));
        element.displacements.resize(3, static_cast<Eigen::Index>(nodes.size()));
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            element.places.col(static_cast<Eigen::Index>(k)) = mesh.points[nodes[k]];
            element.displacements.col(static_cast<Eigen::Index>(k)) = displacements[nodes[k]];
        }
        for (const QuadraturePoint& point : quadrature(solid.type)) {
            CrackFront::Place at;
            if (!front.find(element.places * point.values, domain.outer, at)) continue;
            const double r = std::hypot(at.x1, at.x2), theta = std::atan2(at.x2, at.x1);
            if (r == 0) continue;
            Eigen::Matrix3d gradient;
            const double weight = point.weight * local_gradient(element, point, at.frame, gradient);
            std::array<Contribution, 3> modes;
            for (int mode = 1; mode <= 3; ++mode)
                modes[mode - 1] = contribution(auxiliary_field(mode, r, theta, elasticity), gradient, at, r,
                                               plateau(r, domain), elasticity);
            for (std::size_t k = 0; k < places.size(); ++k) {
                const bool tip = front.length() == 0;
                const auto [share, slope] =
                    tip ? std::array<double, 2>{1, 0} : hat(front.along(places[k], at.s), domain.along);
                if (share == 0) continue;
                for (int m = 0; m < 3; ++m) out[k][m] += weight * (share * modes[m].level + slope * modes[m].slope);
            }
        }
    }
    for (std::size_t k = 0; k < places.size(); ++k) {
        const double width = width_at(front, places[k], domain.along);
        out[k][0] *= elasticity.effective() / (2 * width);
        out[k][1] *= elasticity.effective() / (2 * width);
        out[k][2] *= elasticity.shear() / width;
    }
    return out;
}

}  // namespace femscalpel
