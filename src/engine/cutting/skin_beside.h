// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "mesh/band_mesh.h"

namespace femscalpel {

/// The skin of a band's solid as it is, without faces between two elements, to ask where a path leaves the material.
class SkinBeside {
public:
    /// The band must outlive this, and keep its nodes and faces.
    explicit SkinBeside(const BandMesh& band);

    /// Where a path that leads into the material leaves it for longer than `length`, if it does.
    std::optional<Vec3> exit(const Vec3& from, const Vec3& to, double length) const;

private:
    struct Hits;

    const Vec3& corner(int slot, int k) const { return band_.nodes[band_.skin[slot][k]].at; }
    Vec3 outwards(int slot) const;

    const BandMesh& band_;
    std::vector<int> slots_;
    std::vector<Vec3> outwards_;
    Eigen::KdBVH<double, 3, int> tree_;
};

}  // namespace femscalpel
