// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/distance_field.h"

#include <cmath>
#include <memory>
#include <nanoflann.hpp>
#include <string>

#include "error.h"

namespace femscalpel {
namespace {

/// Points in the form nanoflann asks for, and its search tree.
struct NearestPoint {
    struct Cloud {
        std::vector<Eigen::Vector3d> points;
        std::size_t kdtree_get_point_count() const { return points.size(); }
        double kdtree_get_pt(std::size_t k, std::size_t axis) const {
            return points[k][static_cast<Eigen::Index>(axis)];
        }
        template <class Box>
        bool kdtree_get_bbox(Box&) const {
            return false;
        }
    };
    using Distance = nanoflann::L2_Simple_Adaptor<double, Cloud>;

    explicit NearestPoint(std::vector<Eigen::Vector3d> points) : cloud{std::move(points)}, tree(3, cloud) {}

    Cloud cloud;
    nanoflann::KDTreeSingleIndexAdaptor<Distance, Cloud, 3, std::size_t> tree;
};

}  // namespace

DistanceField distance_to(std::vector<const Tool*> tools) {
    if (tools.empty()) throw ToolError("near is empty: give a tool or points to refine around", "near");
    return [tools = std::move(tools)](const Eigen::Vector3d& x) {
        double nearest = tools[0]->distance(x);
        for (std::size_t k = 1; k < tools.size(); ++k)
            if (const double d = tools[k]->distance(x); std::abs(d) < std::abs(nearest)) nearest = d;
        return nearest;
    };
}

DistanceField distance_to(std::vector<Eigen::Vector3d> points) {
    if (points.empty()) throw ToolError("near is empty: give a tool or points to refine around", "near");
    for (std::size_t k = 0; k < points.size(); ++k)
        if (!points[k].allFinite())
            throw ToolError("near: point " + std::to_string(k) + " has a value that is not a finite number", "near");
    return [search = std::make_shared<const NearestPoint>(std::move(points))](const Eigen::Vector3d& x) {
        std::size_t nearest = 0;
        double squared = 0;
        [[maybe_unused]] const auto found = search->tree.knnSearch(x.data(), 1, &nearest, &squared);  // always one
        return std::sqrt(squared);
    };
}

}  // namespace femscalpel
