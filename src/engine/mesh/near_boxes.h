// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <utility>
#include <vector>

namespace femscalpel {

/// All pairs of a box of the first and one of the second that meet, by index, ascending; by Eigen's BVIntersect().
std::vector<std::pair<int, int>> near_boxes(const std::vector<Eigen::AlignedBox3d>& first,
                                            const std::vector<Eigen::AlignedBox3d>& second);

}  // namespace femscalpel
