// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>

namespace femscalpel {

/// A point seen from an axis: how far along it, how far from it and in which direction.
struct AxisFrame {
    AxisFrame(const Eigen::Vector3d& x, const Eigen::Vector3d& origin, const Eigen::Vector3d& unit_axis) {
        const Eigen::Vector3d r = x - origin;
        height = unit_axis.dot(r);
        outward = r - height * unit_axis;
        radius = outward.norm();
        // On the axis itself every direction across it is as good.
        if (radius > 1e-300)
            outward /= radius;
        else
            outward = unit_axis.unitOrthogonal();
    }

    double height;
    double radius;
    Eigen::Vector3d outward;  ///< unit vector from the axis to the point
};

}  // namespace femscalpel
