// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "tools/tool.h"

namespace femscalpel {

/// A part of a tool's surface, bounded by curves in which other tools, its sides, cross the surface: where a crack is,
/// its border being the crack front.
struct Patch {
    std::vector<std::unique_ptr<Tool>> sides;
    /// Not positive inside; zero on the border exactly, near it about the distance to it.
    std::function<double(const Eigen::Vector3d&)> distance;
    /// Which side the border nearest to a point is on.
    std::function<int(const Eigen::Vector3d&)> side;
    /// Where two sides meet: must be a node.
    struct Corner {
        Eigen::Vector3d at;
        int sides[2];
    };
    std::vector<Corner> corners;
    /// Half the least width, or infinity: of a disk the radius. The mesh must be finer than this to show its shape.
    double feature_size = std::numeric_limits<double>::infinity();

    /// Whether `tool` is one of the sides.
    bool has(const Tool* tool) const;
};

/// What a crack can be kept within. A new shape is one class with this function.
class Within {
public:
    virtual ~Within() = default;

    /// The patch of the surface of `tool`. Throws ToolError when the shape is for other tools, or does not lie on this
    /// one.
    virtual Patch on(const Tool& tool) const = 0;
};

/// A disk in a plane.
class Disk final : public Within {
public:
    /// Throws ToolError when the radius is not positive.
    Disk(const Eigen::Vector3d& center, double radius);
    Patch on(const Tool& tool) const override;

private:
    Eigen::Vector3d center_;
    double radius_;
};

/// An ellipse in a plane, `direction` along the first of its two half axes.
class Ellipse final : public Within {
public:
    /// `first` and `second` are the half axes. Throws ToolError when they are not positive, or `direction` is zero.
    Ellipse(const Eigen::Vector3d& center, double first, double second, const Eigen::Vector3d& direction);
    Patch on(const Tool& tool) const override;

private:
    Eigen::Vector3d center_;
    double first_, second_;
    Eigen::Vector3d direction_;
};

/// A polygon in a plane, by its corners in either sense; it need not be convex. Throws ToolError when sides cross.
class Polygon final : public Within {
public:
    explicit Polygon(std::vector<Eigen::Vector3d> corners);
    Patch on(const Tool& tool) const override;

private:
    std::vector<Eigen::Vector3d> corners_;
};

/// The half of a plane on the side of the line through `origin` that `direction` points to, the line being normal to
/// `direction`.
class HalfPlane final : public Within {
public:
    /// Throws ToolError when `direction` is zero.
    HalfPlane(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);
    Patch on(const Tool& tool) const override;

private:
    Eigen::Vector3d origin_, direction_;
};

/// A part of a cylinder: from `low` to `high` along its axis, measured from its origin; and, if given, from `start` to
/// `end` (degrees, start < end < start + 360) about its axis, measured from `zero`, right-handed.
class CylinderPart final : public Within {
public:
    /// From `start` to `end`, in degrees about the axis, right-handed, measured from the direction `zero`.
    struct Angles {
        double start, end;
        Eigen::Vector3d zero;
    };
    CylinderPart(double low, double high, std::optional<Angles> angles = {});
    Patch on(const Tool& tool) const override;

private:
    double low_, high_;
    std::optional<Angles> angles_;
};

}  // namespace femscalpel
