// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// The faces of a solid, or else the edges of a shell, that a group covers, by their corner nodes, ascending, each
/// once; of an edge the third is -1.
struct Covered {
    bool faces = false;  ///< the mesh is one of volume elements
    std::vector<std::array<Index, 3>> parts;
};

/// The corners of a face, or of an edge, with -1 as the third, as Covered has them.
std::array<Index, 3> ascending(std::array<Index, 3> corners);

/// What a group covers of the skin of a solid (of the border of shells): an element group its faces (edges), which may
/// also be inside, a facet group its facets, a node group the faces of the skin (edges of the border) all of whose
/// corners are members.
/// Faces of the facet group `skin_inside`, if any, count as skin to a node group, too.
///
/// Throws ToolError that names `group` when that is nothing, or the group is one of volumes, or of shells in a mesh of
/// shells; UnsupportedElementError when it covers quadrangles.
Covered covered_by(const Mesh& mesh, GroupIndex group, std::optional<GroupIndex> skin_inside = {});

}  // namespace femscalpel
