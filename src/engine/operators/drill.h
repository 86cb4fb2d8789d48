// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"
#include "tools/tool.h"

namespace femscalpel {

/// What the user of drill() can choose.
struct DrillOptions : OperatorOptions {
    DrillOptions() { name = "HOLE"; }  // new groups: NAME_WALL, NAME_BOTTOM

    /// Blind holes: how far they go from each cylinder's origin along its axis; the bottom is flat. Through holes when
    /// absent, and, with a warning, where the bottom would lie beyond the part.
    std::optional<double> depth;
};

/// Drills holes (paper, 3.2): takes out what lies on the negative side of each tool (of a cylinder, sphere, torus:
/// inside), with everything only the removed elements carried, and makes the walls lie on the tools. Several tools make
/// several holes; they may overlap. The input is not changed.
///
/// New groups: NAME_WALL, the faces on the tools (triangles of a volume mesh, normals out of the material; segments of
/// a shell mesh); with several tools also one per hole, NAME_WALL1, ... in their order; NAME_BOTTOM, the bottoms of
/// blind holes. Node sets of the report: IHN and EHN (hole, inside and on the outside), ITN and ETN. Groups that lose
/// all their members stay, empty.
///
/// Throws ToolError (bad name or depth, a tool that misses the mesh or would remove all of it),
/// UnsupportedElementError, QualityError as crack() does.
Result drill(const Mesh& mesh, std::span<const Tool* const> tools, const DrillOptions& options = {},
             const Prepared& prepared = {});

}  // namespace femscalpel
