// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"

namespace femscalpel::checks {

/// A workpiece with the whole mesh in its band, in which all nodes may move; nodes on the tool are in contact with it,
/// nothing is cut. `tool` has to live as long.
Workpiece whole_workpiece(const Mesh& mesh, const Tool& tool);

/// The band node there.
int node_at(const BandMesh& band, const Vec3& at);

}  // namespace femscalpel::checks
