// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "cutting/workpiece.h"

namespace femscalpel {

/// A beam, and where tools pass through it.
struct BeamCut {
    CellRef beam;
    std::vector<double> at;  ///< reference coordinates from its first end (0) to its second (1), ascending
};

/// What tools do to the beams of a mesh: segments (trusses, rods and cables, too) that are no edges of other elements,
/// have a length, and can be divided, as springs, dashpots and gaps of a solver's input cannot.
struct BeamCuts {
    std::vector<BeamCut> cuts;
    /// Nodes (indices, ascending) that a tool passes so near by, without lying on them, that what is between them were
    /// too short: it is as if it passed through them.
    std::vector<Index> stops;

    bool empty() const { return cuts.empty() && stops.empty(); }
};

/// Finds where beams pass through blades, where these are wanted. What is nearer to a node of the beam than a
/// thousandth of it is in that node.
BeamCuts find_beam_cuts(const Mesh& mesh, std::span<const Blade> blades);

}  // namespace femscalpel
