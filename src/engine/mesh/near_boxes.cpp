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

/// For Eigen's BVIntersect: whether any of the boxes meets one.
struct Meets {
    const std::vector<Eigen::AlignedBox3d>& boxes;
    const Eigen::AlignedBox3d& box;
    bool found = false;

    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVIntersect() calls them.
    bool intersectVolume(const Eigen::AlignedBox3d& b) const { return b.intersects(box); }
    bool intersectObject(int k) {
        found = found || boxes[k].intersects(box);
        return found;
    }
    // NOLINTEND(readability-identifier-naming)
};

}  // namespace

BoxTree::BoxTree(std::vector<Eigen::AlignedBox3d> boxes) : boxes_(std::move(boxes)) {
    std::vector<int> objects(boxes_.size());
    std::iota(objects.begin(), objects.end(), 0);
    tree_.init(objects.begin(), objects.end(), boxes_.begin(), boxes_.end());
    for (const Eigen::AlignedBox3d& b : boxes_) all_.extend(b);
}

bool BoxTree::meets(const Eigen::AlignedBox3d& box) const {
    if (!all_.intersects(box)) return false;
    Meets meets{boxes_, box};
    Eigen::BVIntersect(tree_, meets);
    return meets.found;
}

std::vector<std::pair<int, int>> near_boxes(const std::vector<Box>& first, const std::vector<Box>& second) {
    if (first.empty() || second.empty()) return {};
    Pairs pairs{first, second, {}};
    Eigen::BVIntersect(tree_of(first), tree_of(second), pairs);
    std::ranges::sort(pairs.found);
    return std::move(pairs.found);
}

}  // namespace femscalpel
