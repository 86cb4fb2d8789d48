// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/near_boxes.h"

#include <algorithm>
#include <numeric>
#include <unsupported/Eigen/BVH>

namespace femscalpel {
namespace {

using Box = Eigen::AlignedBox3d;

/// For Eigen's BVIntersect().
struct Pairs {
    const std::vector<Box>& first;
    const std::vector<Box>& second;
    std::vector<std::pair<int, int>> found;

    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVIntersect() calls them.
    bool intersectVolumeVolume(const Box& a, const Box& b) { return a.intersects(b); }
    bool intersectVolumeObject(const Box& a, int b) { return a.intersects(second[b]); }
    bool intersectObjectVolume(int a, const Box& b) { return first[a].intersects(b); }
    bool intersectObjectObject(int a, int b) {
        if (first[a].intersects(second[b])) found.push_back({a, b});
        return false;
    }
    // NOLINTEND(readability-identifier-naming)
};

Eigen::KdBVH<double, 3, int> tree_of(const std::vector<Box>& boxes) {
    std::vector<int> objects(boxes.size());
    std::iota(objects.begin(), objects.end(), 0);
    return {objects.begin(), objects.end(), boxes.begin(), boxes.end()};
}

}  // namespace

std::vector<std::pair<int, int>> near_boxes(const std::vector<Box>& first, const std::vector<Box>& second) {
    if (first.empty() || second.empty()) return {};
    Pairs pairs{first, second, {}};
    Eigen::BVIntersect(tree_of(first), tree_of(second), pairs);
    std::ranges::sort(pairs.found);
    return std::move(pairs.found);
}

}  // namespace femscalpel
