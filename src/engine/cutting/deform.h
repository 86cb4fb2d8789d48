// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"

namespace femscalpel {

/// The paper's 3.1.1 and 3.1.2: finds a surface of element faces (edges, for shells) near the tool between a
/// set T1 and a set T2 of elements, then moves its nodes, the interface nodes (CI), onto the tool.
///
/// T1 and T2 are the half-spaces', except that nodes near the tool may join either side: of all surfaces
/// the one whose nodes have least to move is taken (a least vertex cut), which also does the paper's
/// handing over of elements with three interface faces. Nodes that would be in the way (two on one crease,
/// say) are made dearer and the cut is repeated.
///
/// The only nodes added are Figure 4's, on its condition in full: each edge that joins two interface nodes
/// but is in no interface face would come to lie in the tool and flatten what is between, so it is split in
/// the middle. The interface nodes are put on the tool, the bar network carries the transition nodes along,
/// and elements turned over by that are untangled before all are relaxed. When elements remain bad,
/// the nodes around them are made dearer and another surface is tried, a few times.
///
/// No element comes out inverted or nearly flat, and no node on the wrong side of the tool. Throws
/// QualityError naming the elements in the way when no surface tried can be moved there.
void deform_to_tool(Workpiece& workpiece, const Tool& tool, const Mesh& mesh);

}  // namespace femscalpel
