// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>

namespace femscalpel {

/// A surface to cut with, known by its signed distance. The positive side is the one the normal points
/// to (for closed tools: outside). A new tool is one class with these functions.
class Tool {
public:
    virtual ~Tool() = default;

    /// What the surface is called in constraint counts and messages, e.g. "plane".
    virtual std::string kind() const = 0;

    /// Signed distance of `x` to the surface, in the mesh's unit.
    virtual double distance(const Eigen::Vector3d& x) const = 0;

    /// Unit gradient of distance() at `x`: the surface's normal at the point closest to `x`.
    virtual Eigen::Vector3d normal(const Eigen::Vector3d& x) const = 0;

    /// The point of the surface closest to `x`.
    virtual Eigen::Vector3d project(const Eigen::Vector3d& x) const { return x - distance(x) * normal(x); }

    /// Smallest radius of curvature, or infinity: the mesh must be finer than this to follow the surface.
    virtual double feature_size() const = 0;

    /// Whether the surface has a border of its own, beyond which it does not cut.
    virtual bool bounded() const { return false; }

    /// How far the point of the surface closest to `x` lies beyond the border; negative inside it.
    virtual double beyond(const Eigen::Vector3d&) const { return -std::numeric_limits<double>::infinity(); }
};

}  // namespace femscalpel
