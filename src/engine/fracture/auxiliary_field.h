// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

namespace femscalpel {

/// Isotropic elasticity.
struct Elasticity {
    double young;               ///< Young's modulus
    double poisson;             ///< Poisson's ratio
    bool plane_stress = false;  ///< of a mesh of shells

    double shear() const { return young / (2 * (1 + poisson)); }
    /// Kolosov's constant.
    double kappa() const { return plane_stress ? (3 - poisson) / (1 + poisson) : 3 - 4 * poisson; }
    /// E' of K^2 / E': the modulus of plane strain, or of plane stress.
    double effective() const { return plane_stress ? young : young / (1 - poisson * poisson); }
    Eigen::Matrix3d stress(const Eigen::Matrix3d& strain) const;
    Eigen::Matrix3d strain(const Eigen::Matrix3d& stress) const;
};

/// The asymptotic field around a straight crack front whose stress intensity is 1 in one mode and 0 in the others, in
/// the frame b, n, t (1: ahead, 2: normal to the crack, 3: along the front). Williams, J. Appl. Mech. 24 (1957).
struct AuxiliaryField {
    Eigen::Vector3d displacement;
    Eigen::Matrix3d gradient;  ///< du_i / dx_j, of a field that does not change along 3
    Eigen::Matrix3d stress;
};

/// `mode` is 1, 2 or 3; r > 0, -pi <= theta <= pi.
AuxiliaryField auxiliary_field(int mode, double r, double theta, const Elasticity& elasticity);

}  // namespace femscalpel
