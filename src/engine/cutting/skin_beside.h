// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "deformation/deformable.h"

namespace femscalpel {

/// The skin of a band's solid as it is, without faces between two elements, or the border of its shells, to ask where a
/// path leaves the material.
class SkinBeside {
public:
    /// Of the solid's skin. The band need not outlive this.
    static SkinBeside of_solid(const BandMesh& band);
    /// Of the border of shells: strips that stand on it, across the shells, an edge high on both sides.
    static SkinBeside of_shells(const Deformable& d);

    /// Where a path that leads into the material leaves it for longer than `length`, if it does. With `normal`, that of
    /// the shell the path runs in, only the border of shells that lie more or less in that plane counts.
    std::optional<Vec3> exit(const Vec3& from, const Vec3& to, double length, const Vec3& normal = Vec3::Zero()) const;

private:
    struct Face {
        std::array<Vec3, 3> corner;
        Vec3 outwards;
        Vec3 shell_normal = Vec3::Zero();
    };
    struct Hits;

    explicit SkinBeside(std::vector<Face> faces);

    std::vector<Face> faces_;
    Eigen::KdBVH<double, 3, int> tree_;
};

}  // namespace femscalpel
