// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tools/tool.h"

namespace femscalpel {

/// A circular cone, from its apex on without end; the positive side is outside.
class Cone final : public Tool {
public:
    /// The cone around the line through `origin` along `axis` (any length) that has `radius` at `origin` and gets wider
    /// along the axis, by `half_angle` degrees between axis and surface. Its apex lies radius / tan(half_angle) before
    /// `origin`. Throws ToolError when the axis is zero, the radius not positive, the angle not between 0 and 90 or a
    /// value not finite.
    Cone(const Eigen::Vector3d& origin, const Eigen::Vector3d& axis, double radius, double half_angle);

    const Eigen::Vector3d& origin() const { return origin_; }
    const Eigen::Vector3d& unit_axis() const { return axis_; }
    double radius() const { return radius_; }
    double half_angle() const { return half_angle_; }
    Eigen::Vector3d apex() const { return apex_; }

    std::string kind() const override { return "cone"; }
    double distance(const Eigen::Vector3d& x) const override;
    /// On the axis, where every direction around it is as good, one of them; behind the apex away from it.
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override;
    /// The radius of curvature at `origin`. Towards the apex it is smaller: a mesh cannot follow a cone to its apex.
    double feature_size() const override;

private:
    Eigen::Vector3d origin_;
    Eigen::Vector3d axis_;
    double radius_;
    double half_angle_;
    double sine_, cosine_;
    Eigen::Vector3d apex_;
};

}  // namespace femscalpel
