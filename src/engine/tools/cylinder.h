// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tools/tool.h"

namespace femscalpel {

/// An infinite circular cylinder; the positive side is outside.
class Cylinder final : public Tool {
public:
    /// Cylinder of `radius` around the line through `origin` along `axis` (any length). Throws ToolError when the axis
    /// is zero, the radius not positive or a value not finite.
    Cylinder(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double radius);

    const Eigen::Vector3d& origin() const { return origin_; }
    const Eigen::Vector3d& unit_axis() const { return axis_; }
    double radius() const { return radius_; }

    std::string kind() const override { return "cylinder"; }
    double distance(const Eigen::Vector3d& x) const override;
    /// On the axis itself, where every direction is as good, some unit vector across it.
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override;
    double feature_size() const override { return radius_; }

private:
    Eigen::Vector3d from_axis(const Eigen::Vector3d& x) const;

    Eigen::Vector3d origin_;
    Eigen::Vector3d axis_;
    double radius_;
};

}  // namespace femscalpel
