// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mesh/mesh.h"

namespace femscalpel {

/// The group whose nodes are nearest to a place, to tell users where that is.
struct NearestGroup {
    std::string name;     ///< empty when there is none
    double distance = 0;  ///< of its nearest node
};

/// Of nodes, of facets, and of elements that are no bodies of the mesh (faces of solids, edges of shells). Of groups
/// that are about as near the one with the fewest nodes: it says most. The group `except` does not count.
NearestGroup nearest_group(const Mesh& mesh, const Vec3& place, const std::string& except = "");

}  // namespace femscalpel
