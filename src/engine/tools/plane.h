// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "tools/tool.h"

namespace femscalpel {

/// An infinite plane.
class Plane final : public Tool {
public:
    /// Plane through `origin`, normal to `normal` (any length). Throws ToolError when the normal is
    /// zero or a value is not finite.
    Plane(const Eigen::Vector3d& origin, const Eigen::Vector3d& normal);

    const Eigen::Vector3d& origin() const { return origin_; }
    const Eigen::Vector3d& unit_normal() const { return normal_; }

    std::string kind() const override { return "plane"; }
    double distance(const Eigen::Vector3d& x) const override { return normal_.dot(x - origin_); }
    Eigen::Vector3d normal(const Eigen::Vector3d&) const override { return normal_; }
    double feature_size() const override;

private:
    Eigen::Vector3d origin_;
    Eigen::Vector3d normal_;
};

}  // namespace femscalpel
