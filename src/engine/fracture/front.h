// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// A crack front and the frame that goes with each of its places: along `b` the crack would grow, `n` is normal to it,
/// from its negative to its positive side, and t = b x n is tangent. In a mesh of shells it is a tip: a single place.
class CrackFront {
public:
    /// What a point is to the front.
    struct Place {
        double s;               ///< arc length of its foot; below 0 and beyond length() on the tangents at open ends
        double x1, x2;          ///< along b and n
        double curvature;       ///< of the front at the foot: dx/ds = (1 + curvature x1) t along it
        Eigen::Matrix3d frame;  ///< rows b, n, t at the foot
    };

    /// Nodes in order, the first again at the end of a closed front; `ahead` points, at each of them (roughly) into the
    /// material ahead of the front, and `normal` to the positive side.
    CrackFront(std::vector<Vec3> points, const std::vector<Vec3>& ahead, const std::vector<Vec3>& normals);

    bool closed() const { return closed_; }
    /// Of a tip 0.
    double length() const { return s_.back(); }
    /// Arc lengths of the points.
    const std::vector<double>& s() const { return s_; }
    const std::vector<Vec3>& points() const { return points_; }

    /// The place of a point, by its nearest foot on the front; looked for among the points no farther than `reach` from
    /// it in a straight line. False where there is none.
    bool find(const Vec3& point, double reach, Place& place) const;

    /// Distance from s to t along the front: the shorter way round a closed one; signed from s to t.
    double along(double s, double t) const;

private:
    struct Curve {
        Vec3 at, first, second;  // by arc length, nearly
    };
    Curve curve(std::size_t piece, double u) const;
    bool is_foot(std::size_t piece, const Vec3& point, double& u) const;

    std::vector<Vec3> points_, slopes_, normals_;
    std::vector<double> s_;
    bool closed_ = false;
};

}  // namespace femscalpel
