// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/mesh.h"
#include "tools/tool.h"

namespace femscalpel {

/// Where a tool meets a mesh (DESIGN 3, step 1).
struct Location {
    std::vector<double> distance;    ///< signed, by node
    std::vector<std::int8_t> level;  ///< 0: node of an element the tool touches; k: k edges away; -1: farther than `levels`
    double tolerance = 0;            ///< nodes nearer than this lie on the tool
    Index crossed = 0;               ///< triangles and tetrahedra the tool passes through
};

/// Measures all nodes and finds those within `levels` edges of the elements the tool touches. One pass
/// over the nodes, one over the elements and one per level, unless `adjacency` (elements around nodes) is
/// given, which makes the levels cost only the band.
///
/// Throws ToolError when the tool misses the mesh: says how far away it is, and on which side.
Location locate(const Mesh& mesh, const Tool& tool, int levels, const Adjacency* adjacency = nullptr);

}  // namespace femscalpel
