// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cutting/workpiece.h"
#include "mesh/adjacency.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// Where tools meet a mesh (resources/docs/architecture.md, "locate").
struct Location {
    std::vector<double> distance = {};  ///< signed, to the first tool, by node
    std::vector<std::int8_t> level =
        {};                ///< 0: node of an element the tool touches; k: k edges away; -1: farther than `levels`
    double tolerance = 0;  ///< what is nearer than this lies on the tool
    double rounding =
        0;  ///< coordinate_rounding() of the mesh, at least `tolerance`: nodes nearer than this are on the tool
    std::vector<Index> stops = {};  ///< indices, ascending, of the nodes with the numbers `stops`
    Index crossed = 0;              ///< triangles and tetrahedra a tool passes through
};

/// How near to a tool something lies on it: Location::tolerance, Location::rounding.
struct Reach {
    double tolerance;
    double rounding;
};

/// That of a mesh.
Reach reach_of_rounding(const Mesh& mesh);

/// Measures all nodes and finds those within `levels` edges of the elements the blades touch, of segments
/// those on them. One pass
/// over the nodes, one over the elements and one per level, unless `adjacency` (elements around nodes) is
/// given, which makes the levels cost only the band.
///
/// Nodes with the numbers `stops` are on the tools, too.
///
/// Throws ToolError when a tool parts no nodes of an element and none lie on it: why_missed().
Location locate(const Mesh& mesh, std::span<const Blade> blades, int levels, const Adjacency* adjacency = nullptr,
                std::span<const Index> stops = {});

/// The paper's bandwidth: largest distance between an interface node and the tool, in mean edge lengths; at least 2.
int bandwidth(const Location& location, const Mesh& mesh);

/// Gives nodes without a level (-1) that are k <= `count` edges away from those of level 0 the level k.
void spread_levels(const Mesh& mesh, std::vector<std::int8_t>& levels, int count, const Adjacency* adjacency = nullptr);

}  // namespace femscalpel
