// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"
#include "tools/patch.h"

namespace femscalpel {

/// Makes edges of the interface (BandMesh::cut_faces and cut_edges) lie along the border of a patch of the tool: the
/// crack front. As cut_along() does in the volume: corners of the patch become nodes, nodes near the border are moved
/// onto it within the interface, edges of the interface that still cross are bisected on it.
///
/// Throws QualityError when a corner cannot be made a node.
void cut_border(Workpiece& workpiece, const Patch& patch);

/// Leaves on the tool only the faces inside the patch: takes the others out of cut_faces and cut_edges, and the contact
/// from nodes on none that is left. Throws ToolError when the patch is finer than the mesh.
void keep_patch(Workpiece& workpiece, const Patch& patch);

/// A face of the crack all of whose nodes are on the front would stay closed: its longest edge inside the crack, or on
/// the skin, gets a node in between. So does an edge of the skin that joins two nodes of the front across the crack's
/// mouth, and an edge of a shell's crack between two tips, and an edge inside the crack from front to front, along
/// which the lips would hang together. True if there was any.
bool part_closed_faces(Workpiece& workpiece, const Patch& patch);

}  // namespace femscalpel
