// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "operators/prepared.h"
#include "operators/report.h"
#include "tools/tool.h"

namespace femscalpel {

/// Where reshape() moves what a group covers, and what else its user can choose. Exactly one of `onto`, `by` and
/// `scale`.
struct ReshapeOptions {
    /// Multiplies distances from a point.
    struct Scale {
        double factor = 1;
        Vec3 centre = Vec3::Zero();
    };
    std::string name = "SHAPE";                        ///< prefix of the new group: NAME_WALL
    const Tool* onto = nullptr;                        ///< the surface to move it onto
    std::optional<Vec3> by;                            ///< how far to move it
    std::optional<Scale> scale;                        ///< or to make it larger or smaller
    double feature_angle = 30;                         ///< degrees; a skin edge sharper than this is a feature line
    std::optional<std::vector<std::string>> preserve;  ///< as OperatorOptions::preserve
    bool strict = false;  ///< Error instead of warnings where the solver's input cannot follow (carry_over.h)
};

/// Moves the wall that a group covers (covered_by()): faces of a solid's skin, or between its groups of elements; edges
/// of a shell's border. Onto a tool, by a vector, or scaled about a point; the elements around it follow (move_wall()),
/// and are divided and merged where they get long, short or poor. The input is not changed.
///
/// Nodes of the wall come to lie on the tool, mid-side nodes too. With `by` and `scale` that tool is the plane,
/// cylinder or sphere the wall is on, moved likewise, each of its patches for itself; patches of other shapes are
/// carried as they are. The part of the motion that runs along the wall itself does not count. Nodes that are on other
/// surfaces or lines, too - the wall's rim - slide on these: planes and lines go on beyond where they end. Where a wall
/// has to be carried as it is, these have to run along the motion.
///
/// New group: NAME_WALL, the wall's nodes. Node sets of the report: WALL, and BAND, the other nodes that moved.
///
/// Throws ToolError (not just one of onto, by and scale; a group that is none, or covers nothing; a motion that has no
/// room, turns elements inside out or leads out of what is beside the wall), UnsupportedElementError (elements other
/// than triangles and tetrahedra near the wall), QualityError (elements near it are inverted in the input).
Result reshape(const Mesh& mesh, const std::string& group, const ReshapeOptions& options, const Prepared& known = {});

}  // namespace femscalpel
