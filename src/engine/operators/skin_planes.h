// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "operators/coordinate_slack.h"

namespace femscalpel {

/// The planes in which parts of a skin of triangles lie where its coordinates were rounded, found from all of a part's
/// nodes: what single triangles tell is off the more, the smaller they are. There are none where coordinates were not
/// rounded, as every triangle then tells all.
class SkinPlanes {
public:
    /// The points x with normal . x = offset.
    struct Plane {
        Vec3 normal;  ///< out of the material
        double offset;
    };

    /// `skin` as by skin_of().
    SkinPlanes(const Mesh& mesh, std::span<const std::array<Index, 3>> skin);

    /// That of the triangles that are joined to one, and flat but for what rounding does to them, if all their nodes
    /// lie in it.
    std::optional<Plane> of(const std::array<Index, 3>& triangle) const;

private:
    std::optional<Plane> fit(const Mesh& mesh, std::span<const std::array<Index, 3>> part) const;

    CoordinateSlack slack_;
    std::map<std::array<Index, 3>, std::size_t> part_;  // of triangles
    std::vector<std::optional<Plane>> planes_;          // by part
};

}  // namespace femscalpel
