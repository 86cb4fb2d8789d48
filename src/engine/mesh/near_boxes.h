// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>
#include <utility>
#include <vector>

namespace femscalpel {

/// Some boxes, to ask whether one meets any of them.
class BoxTree {
public:
    explicit BoxTree(std::vector<Eigen::AlignedBox3d> boxes);

    bool meets(const Eigen::AlignedBox3d& box) const;

    /// The box around all.
    const Eigen::AlignedBox3d& all() const { return all_; }

private:
    std::vector<Eigen::AlignedBox3d> boxes_;
    Eigen::KdBVH<double, 3, int> tree_;
    Eigen::AlignedBox3d all_;
};

/// All pairs of a box of the first and one of the second that meet, by index, ascending; by Eigen's BVIntersect().
std::vector<std::pair<int, int>> near_boxes(const std::vector<Eigen::AlignedBox3d>& first,
                                            const std::vector<Eigen::AlignedBox3d>& second);

}  // namespace femscalpel
