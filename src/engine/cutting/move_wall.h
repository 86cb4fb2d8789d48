// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/wall_motion.h"

namespace femscalpel {

/// What move_wall() did.
struct MovedWall {
    int steps = 0;
    int taken_out = 0;  ///< nodes of the input that were merged away
};

/// Moves a wall to its goals in steps of a part of the edges there, the band following each time: through the network
/// of bars, relaxation, and remeshing (Remesher). A step that would spoil elements is tried again in halves. In the end
/// the wall's nodes are on their tools, in contact with them.
///
/// Throws ToolError naming WallMotion::parameter where nodes cannot get there, or no step is small enough.
MovedWall move_wall(Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh);

/// What move_wall() looks at before it moves anything, and throws: whether nodes can get there, and the ways there stay
/// in the material and on what they slide on. Costs little.
void check_way(Workpiece& f, const Wall& wall, const WallMotion& motion, const Mesh& mesh);

}  // namespace femscalpel
