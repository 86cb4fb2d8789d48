// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"
#include "operators/unite.h"

namespace femscalpel {

/// Options of merge() beside those of all operators, of which `name`, `feature_angle` and `strict` count.
struct MergeOptions : OperatorOptions {
    bool keep_addition = false;       ///< where solids overlap, the mesh is cut off, not the addition
    std::optional<double> tolerance;  ///< what is nearer than this touches; a tenth of the shorter mean edge if absent
    std::string prefix;               ///< see UniteNames; the name and "_" if empty
    bool join_groups = true;
    /// Of shells that pass through the mesh, what is on this point's side of it stays; all if absent.
    std::optional<Vec3> keep_side;
    /// No common nodes: both meshes stay as they are, and only touch; see tie().
    bool tie = false;
};

/// How unite() is to call the addition's groups.
UniteNames names_of(const MergeOptions& options);

/// Joins an addition to a mesh (paper, 2.1 and Figure 9): where their surfaces meet, both get the same nodes and edges,
/// along one line, and become one mesh. Shells meet in the lines where they cross, or where the border of one is on the
/// other. The mesh changes only along the line; everything else keeps its number, coordinates and groups. What is
/// added is numbered above what there is, and keeps its groups (see unite()); `name`_SEAM are the shared nodes,
/// `name`_ADDED the addition's elements. An addition of another order is brought to the mesh's.
///
/// Throws ToolError when the two do not meet, or do not fit together, QualityError when no valid mesh can be made.
Result merge(const Mesh& mesh, const Mesh& addition, const MergeOptions& options, const Prepared& known = {});

}  // namespace femscalpel
