// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tools/tool.h"

namespace femscalpel {

/// A sphere; the positive side is outside.
class Sphere final : public Tool {
public:
    /// Throws ToolError when the radius is not positive or a value not finite.
    Sphere(const Eigen::Vector3d& center, double radius);

    const Eigen::Vector3d& center() const { return center_; }
    double radius() const { return radius_; }

    std::string kind() const override { return "sphere"; }
    double distance(const Eigen::Vector3d& x) const override { return (x - center_).norm() - radius_; }
    /// In the centre, where every direction is as good, some unit vector.
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override;
    double feature_size() const override { return radius_; }

private:
    Eigen::Vector3d center_;
    double radius_;
};

}  // namespace femscalpel
