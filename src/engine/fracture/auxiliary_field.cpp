// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fracture/auxiliary_field.h"

#include <cmath>
#include <numbers>

namespace femscalpel {

Eigen::Matrix3d Elasticity::stress(const Eigen::Matrix3d& strain) const {
    const double mu = shear();
    double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    if (!plane_stress) return 2 * mu * strain + lambda * strain.trace() * Eigen::Matrix3d::Identity();
    lambda = 2 * lambda * mu / (lambda + 2 * mu);
    Eigen::Matrix3d out = 2 * mu * strain;
    const double sum = lambda * (strain(0, 0) + strain(1, 1));
    out(0, 0) += sum;
    out(1, 1) += sum;
    out.row(2).setZero();
    out.col(2).setZero();
    return out;
}

Eigen::Matrix3d Elasticity::strain(const Eigen::Matrix3d& stress) const {
    return ((1 + poisson) * stress - poisson * stress.trace() * Eigen::Matrix3d::Identity()) / young;
}

AuxiliaryField auxiliary_field(int mode, double r, double theta, const Elasticity& elasticity) {
    const double c = std::cos(theta / 2), s = std::sin(theta / 2), kappa = elasticity.kappa();
    const double cosine = std::cos(theta), sine = std::sin(theta);
    const double c3 = std::cos(3 * theta / 2), s3 = std::sin(3 * theta / 2);
    // u = sqrt(r / 2 pi) / (2 mu) f(theta), and df / d theta.
    Eigen::Vector3d f = Eigen::Vector3d::Zero(), slope = f;
    AuxiliaryField out;
    out.stress.setZero();
    const double k = 1 / std::sqrt(2 * std::numbers::pi * r);
    const auto set = [&](int i, int j, double value) { out.stress(i, j) = out.stress(j, i) = k * value; };
    if (mode == 1) {
        f = {c * (kappa - cosine), s * (kappa - cosine), 0};
        slope = {-s * (kappa - cosine) / 2 + c * sine, c * (kappa - cosine) / 2 + s * sine, 0};
        set(0, 0, c * (1 - s * s3));
        set(1, 1, c * (1 + s * s3));
        set(0, 1, c * s * c3);
    } else if (mode == 2) {
        f = {s * (kappa + 2 + cosine), -c * (kappa - 2 + cosine), 0};
        slope = {c * (kappa + 2 + cosine) / 2 - s * sine, s * (kappa - 2 + cosine) / 2 + c * sine, 0};
        set(0, 0, -s * (2 + c * c3));
        set(1, 1, s * c * c3);
        set(0, 1, c * (1 - s * s3));
    } else {
        f = {0, 0, 4 * s};
        slope = {0, 0, 2 * c};
        set(0, 2, -s);
        set(1, 2, c);
    }
    if (!elasticity.plane_stress) out.stress(2, 2) = elasticity.poisson * (out.stress(0, 0) + out.stress(1, 1));
    const double size = std::sqrt(r / (2 * std::numbers::pi)) / (2 * elasticity.shear());
    out.displacement = size * f;
    out.gradient.col(0) = size / r * (cosine / 2 * f - sine * slope);
    out.gradient.col(1) = size / r * (sine / 2 * f + cosine * slope);
    out.gradient.col(2).setZero();
    return out;
}

}  // namespace femscalpel
