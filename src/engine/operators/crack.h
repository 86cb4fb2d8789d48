// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"
#include "tools/patch.h"

namespace femscalpel {

/// What the user of crack() can choose.
struct CrackOptions : OperatorOptions {
    CrackOptions() { name = "CRACK"; }  // new groups: NAME_P, NAME_N, NAME_FRONT

    /// The part of the tool that cracks; the whole when null.
    const Within* within = nullptr;
};

/// Cracks `mesh` along `tool` (paper, 3.1): makes element faces lie on the tool, then gives
/// each side its own copy of the interface nodes. Lips are coincident. The input is not changed.
///
/// New groups: NAME_P and NAME_N, the lip faces on the tool's positive and negative side (triangles of a
/// volume mesh, segments of a shell mesh). The original nodes stay with the negative side. Where the two
/// sides hang together at interface nodes, these are the front: node group NAME_FRONT.
///
/// A crack `within` a part of the tool ends in the material: edges of the interface are made to lie on the border of
/// that part. There, in a solid, NAME_FRONT is an element group: new segments along the front, in order (each chain
/// from end to end, a closed one once around). Front nodes are single and lie on the border curve.
///
/// A Face whose border lies inside the material, or a part of its border does, is a crack within that border: the front
/// lies on it.
///
/// Cracks that the mesh has already stay as they are: their lips are skin, kept flat and whole, the nodes of their bent
/// fronts stay in place. Where the new crack crosses one, the material comes apart into as many parts as meet there,
/// each with nodes of its own; the two lips of the old crack need not match node for node there any more, which makes a
/// warning.
///
/// Shells that lie in the tool's surface are parted from those that stand on them: a sheet of them stays with the
/// negative side, or, where others are joined to it on the negative side only, with the positive.
///
/// A tool that passes between quadrangles, prisms or hexahedra only, through none, opens the faces that lie on it and
/// converts nothing (crack_between_elements()).
///
/// Beams (trusses, rods, cables: segments that are no edges of other elements, find_beam_cuts()) are divided on the
/// tool and come apart there, from each other and from elements that are all on the other side. Where nothing else
/// opens, NAME_N and NAME_P are node groups of their ends. Springs, dashpots and gaps of a solver's input stay whole.
///
/// Throws ToolError (bad name, `preserve` names no group, tool misses the mesh), UnsupportedElementError (the band
/// reaches elements other than triangles and tetrahedra), QualityError (no valid mesh can be made).
Result crack(const Mesh& mesh, const Tool& tool, const CrackOptions& options = {}, const Prepared& prepared = {});

}  // namespace femscalpel
