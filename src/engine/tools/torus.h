// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tools/tool.h"

namespace femscalpel {

/// A ring torus; the positive side is outside.
class Torus final : public Tool {
public:
    /// A tube of `minor_radius` around the circle of `major_radius` about `center`, in the plane normal to `axis` (any
    /// length). Throws ToolError when the axis is zero, a radius not positive, a value not finite, or the tube as thick
    /// as the circle: it would cross itself.
    Torus(const Eigen::Vector3d& center, const Eigen::Vector3d& axis, double major_radius, double minor_radius);

    const Eigen::Vector3d& center() const { return center_; }
    const Eigen::Vector3d& unit_axis() const { return axis_; }
    double major_radius() const { return major_; }
    double minor_radius() const { return minor_; }

    std::string kind() const override { return "torus"; }
    double distance(const Eigen::Vector3d& x) const override;
    /// On the axis and on the middle circle, where several directions are as good, one of them.
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override;
    double feature_size() const override;

private:
    Eigen::Vector3d center_;
    Eigen::Vector3d axis_;
    double major_;
    double minor_;
};

}  // namespace femscalpel
