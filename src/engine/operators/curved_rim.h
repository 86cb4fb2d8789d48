// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>

#include "mesh/mesh.h"

namespace femscalpel {

/// An edge that two meshes have in common, by its ends in each.
struct CommonEdge {
    std::array<std::array<Index, 2>, 2> ends;
    bool bound = false;  ///< a border, line or group holds both ends in the first mesh
};

/// What bend_rim() did.
struct BentRim {
    Index bent = 0;      ///< edges
    Index straight = 0;  ///< those that are beside the second mesh's curved skin
    double largest = 0;  ///< how far their middles are
};

/// Two second-order meshes were given common edges along a seam, straight where the first one's surface is flat. Where
/// the second one's own skin, as it was (`own`), is curved along them, puts their mid-side nodes onto that, in both
/// meshes and in the plane of the first one's surface; but where elements would be worse than curved_limit, or the
/// first one's surface is no plane there.
BentRim bend_rim(const Mesh& own, Mesh& first, Mesh& second, std::span<const CommonEdge> edges);

}  // namespace femscalpel
