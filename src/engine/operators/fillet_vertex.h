// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "operators/feature_line.h"
#include "operators/fillet_path.h"
#include "tools/sphere.h"

namespace femscalpel {

/// A corner of three plane faces at which edges that are rounded meet. A ball there touches all three: where all three
/// edges are rounded, the new face is a triangle of it; where two are, these meet in a plane through its centre.
struct FilletVertex {
    /// An edge that begins (0) or ends (1) there.
    struct Member {
        std::size_t edge;
        int which;
    };

    Vec3 at;
    Vec3 to_centre;  ///< from there to the centre of such a ball of radius 1 outside of the material
    std::vector<Member> members;
    bool right_angled;  ///< the faces are at right angles to each other

    // Known after join():
    Vec3 centre = Vec3::Zero();
    std::vector<Vec3> across = {};  ///< by member: normal of the plane in which its own new face ends
    std::shared_ptr<Sphere> sphere = {};

    /// Whether two edges meet in a plane.
    bool is_mitre() const { return members.size() == 2; }
    /// Finds where the new faces of the edges end. Throws ToolError (parameter "along") where they do not go together.
    void join(const std::vector<const FilletPath*>& paths);
};

/// The corners where several of the lines end; `planes` where these are known better than from triangles. Throws
/// ToolError (parameter "along") where these are of another kind.
std::vector<FilletVertex> find_vertices(const Mesh& mesh, std::span<const FeatureLine> lines,
                                        const std::vector<std::array<Index, 3>>& skin,
                                        const SkinPlanes* planes = nullptr);

}  // namespace femscalpel
