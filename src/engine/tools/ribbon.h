// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "tools/tool.h"

namespace femscalpel {

/// A strip that stands on a surface along a polyline: what is cut by it, is cut along the line. Beyond the line's ends
/// it goes on straight.
class Ribbon final : public Tool {
public:
    /// `points`: the line's, at least two, no two in a row the same; a closed line's last is joined to its first.
    /// `standing`: at each point the direction in which the strip stands, the unit normal of the surface, none along
    /// the line. Throws ToolError when these do not fit together.
    Ribbon(std::vector<Eigen::Vector3d> points, std::vector<Eigen::Vector3d> standing, bool closed);

    std::string kind() const override { return "seam"; }
    double distance(const Eigen::Vector3d& x) const override;
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override;
    Eigen::Vector3d project(const Eigen::Vector3d& x) const override;
    double feature_size() const override { return feature_size_; }
    bool bounded() const override { return true; }
    /// The larger of how far it is beyond the line's ends and how far off the line in the direction the strip stands.
    double beyond(const Eigen::Vector3d& x) const override;

    /// Where on the line the point closest to a given one is.
    struct Foot {
        Eigen::Vector3d at;        ///< on the line, or its straight continuation
        Eigen::Vector3d standing;  ///< unit vector, the strip's direction there
        Eigen::Vector3d tangent;   ///< unit vector
        double arc;                ///< length along the line; negative or more than length() beyond its ends
    };
    Foot foot(const Eigen::Vector3d& x) const;

    /// The point at a length along the line, which is wrapped for closed lines and else held to the line.
    Eigen::Vector3d at(double arc) const;

    double length() const { return arcs_.back(); }
    bool closed() const { return closed_; }

    /// From one length along the line to another; of a closed line the shorter way round.
    double arc_between(double from, double to) const;

private:
    std::size_t count() const { return arcs_.size() - 1; }  // of segments
    std::size_t next(std::size_t point) const { return point + 1 == points_.size() ? 0 : point + 1; }
    Eigen::Vector3d tangent_at(std::size_t point) const;

    std::vector<Eigen::Vector3d> points_, standing_;
    std::vector<double> arcs_;  // to each point; of a closed line also to the first again
    bool closed_;
    double feature_size_;
    Eigen::KdBVH<double, 3, int> tree_;  // of segments
};

}  // namespace femscalpel
