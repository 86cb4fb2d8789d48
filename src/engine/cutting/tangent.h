// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "cutting/workpiece.h"
#include "groups/covered.h"

namespace femscalpel {

/// What goes with a wall, by nodes of the mesh as in Covered.
struct Beside {
    std::vector<std::array<Index, 3>> same;       ///< on the same plane, cylinder or sphere, without an edge between
    std::vector<std::array<Index, 3>> following;  ///< tangent to it, such as a fillet at its end: carried along with it
};

/// The parts of a band's skin (border of shells) beside those covered, and those `following` already, that have to go
/// with them: all that are joined to them smoothly, as far as these face the way the wall does. (A fillet follows a
/// wall that is pushed in, up to the face on its other side, along which it then slides.)
///
/// Nothing may have moved in the band. Throws ToolError naming `group` where that is no narrow strip beside the wall.
Beside parts_beside(const Workpiece& f, const Covered& covered, const std::vector<std::array<Index, 3>>& following,
                    double feature_angle);

}  // namespace femscalpel
