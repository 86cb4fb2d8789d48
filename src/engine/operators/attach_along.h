// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "operators/merge.h"

namespace femscalpel {

/// Beams of an addition that lie in a mesh's surface, joined to it all along.
struct AttachedAlong {
    Mesh mesh;                  ///< has edges along the beams
    Report report;              ///< on that
    Mesh addition;              ///< these beams divided where the mesh has nodes
    std::vector<Index> shared;  ///< by node of the addition: the node of the mesh that it is, or -1
    Index on_solids = 0;        ///< beams that lie on solids
};

/// Looks for beams of an addition both ends and the middle of which are on the surface of a mesh, as stiffeners are,
/// and makes them edges of that: the line of the beams is imprinted on it as the foot of a shell that stands there
/// (Joint), and the beams are divided where that needs nodes. Springs, dashpots and gaps of a solver's input stay
/// whole. Nothing where no beam lies so; but `bowed` gets a warning about beams whose ends are on the surface and the
/// middle only nearly.
///
/// Throws QualityError where a beam cannot be joined along its length, and as imprint_seam() does.
std::optional<AttachedAlong> attach_along(const Mesh& mesh, const Mesh& addition, const MergeOptions& options,
                                          const Prepared& known, std::vector<std::string>& bowed);

}  // namespace femscalpel
