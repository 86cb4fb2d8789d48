// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <span>
#include <unordered_map>
#include <unsupported/Eigen/BVH>
#include <utility>
#include <vector>

#include "mesh/surface.h"

namespace femscalpel {

/// Some faces of a mesh's surface, and its border, to ask what is near a point.
class SurfaceTree {
public:
    /// The border is edges that only one of the faces has, and edges of a solid's skin at which it turns by more than
    /// 30 degrees. Both must outlive this.
    SurfaceTree(const Mesh& mesh, std::span<const SurfaceFace> faces);

    /// A point of the surface, or of its border.
    struct Foot {
        Vec3 at = Vec3::Zero();
        double distance = 0;
        int piece = -1;  ///< face, or edge of border(); -1: there is none
    };
    /// The one closest to `x`.
    Foot closest(const Vec3& x) const;
    /// Distance of `x` to a solid's skin, negative inside.
    double signed_distance(const Vec3& x) const;
    Foot closest_on_border(const Vec3& x) const;

    /// Border edges by nodes, in the direction of their face.
    const std::vector<std::pair<Index, Index>>& border() const { return border_; }
    /// The face a border edge is one of.
    int face_at_border(int edge) const { return border_faces_[edge]; }
    /// The mean of the unit normals of the faces there.
    Vec3 border_normal(int edge) const { return border_normals_[edge]; }

    /// Unit normal of a face.
    Vec3 normal(int face) const;
    /// Mean length of its edges.
    double size(int face) const;
    /// How far a smooth surface through the nodes of a face may be off it, by the angles to its neighbours; edges of
    /// more than 40 degrees are not taken for smooth.
    double sag(int face) const { return sags_[face]; }

private:
    bool is_border(const std::vector<int>& faces) const;
    void find_sags(const std::map<std::pair<Index, Index>, std::vector<int>>& edges);

    const Mesh& mesh_;
    std::span<const SurfaceFace> faces_;
    std::vector<std::pair<Index, Index>> border_;
    std::vector<int> border_faces_;
    std::vector<Vec3> border_normals_;
    std::vector<double> sags_;
    std::unordered_map<Index, std::vector<int>> around_;  // faces at a node
    Eigen::KdBVH<double, 3, int> face_tree_, border_tree_;
};

}  // namespace femscalpel
