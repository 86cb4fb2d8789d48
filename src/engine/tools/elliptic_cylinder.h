// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tools/tool.h"

namespace femscalpel {

/// An infinite elliptic cylinder; the positive side is outside. `first` and `second` are half axes, the first one along
/// the unit vector `direction`, across the unit vector `axis`.
class EllipticCylinder final : public Tool {
public:
    EllipticCylinder(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, const Eigen::Vector3d& direction,
                     double first, double second);

    std::string kind() const override { return "elliptic cylinder"; }
    double distance(const Eigen::Vector3d& x) const override;
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override;
    double feature_size() const override;

private:
    struct Foot {
        Eigen::Vector2d at;
        double distance;
    };
    Eigen::Vector2d local(const Eigen::Vector3d& x) const;
    Foot foot(const Eigen::Vector2d& p) const;

    Eigen::Vector3d origin_, u_, v_;
    double a_, b_;
};

}  // namespace femscalpel
