// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "operators/feature_line.h"
#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"

namespace femscalpel {

/// What the user of fillet() can choose.
struct FilletOptions : OperatorOptions {
    FilletOptions() { name = "FILLET"; }  // new group: NAME_FACE
};

/// Rounds edges of a part by the surface of a ball of this radius that rolls along (the paper's Figure 3.c, with
/// elements added): convex edges lose material, concave ones gain it. The nodes of the new face lie on the cylinder (of
/// straight edges) or torus (of circular ones) exactly; it touches the faces on both sides, and runs out through the
/// plane faces where the edge ends, or, concave, ends in one that stands across it. At another corner it stops at the
/// last place where both sides still reach as far as it touches them, in a flat face across the edge. Elements between
/// the edge and the tangent lines are replaced; new ones are in the groups of those they replace. Where groups meet
/// along a concave edge, each gets half of what is added, up to a wall from the edge to the middle of the arc; along a
/// straight convex one, their plane border ends at the new face. The mesh is refined first to four elements over the
/// arc at least.
///
/// Edges that meet at a corner of three plane faces are rounded at once: two, between faces at the same angle, meet in
/// a plane, as mitred; three in the triangle of a sphere.
///
/// New groups: NAME_FACE, the triangles of the new face (normals out of the material), and NAME_END, those of flat
/// faces in which it stops. Throws ToolError (parameter "along": no edge, or not of that kind, convex and concave ones
/// that meet; "radius": too large for the faces), QualityError (no sound mesh, groups that meet beside the edge) and
/// what crack() throws.
Result fillet(const Mesh& mesh, const Along& along, double radius, const FilletOptions& options = {},
              const Prepared& prepared = {});

}  // namespace femscalpel
