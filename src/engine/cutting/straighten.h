// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"

namespace femscalpel {

/// A new node, or the middle of an edge, may be left so far beside the curved surface or curve it belongs on, in edge
/// lengths there, where nothing else gives sound elements: about what an arc of 90 degrees is off its chord.
inline constexpr double farthest_straightened = 0.21;

/// The last resort where a tool nearly touches a coarsely curved skin, and curved elements find no room between the
/// two: gives folded second-order elements straight edges, those first that have no place on their surface or curve,
/// then those that bulge most, until they are sound; elements with straight edges are as sound as their corners.
/// Elements around that get worse by that are treated likewise. Edges on curved tools stay on these unless an element
/// has no room for the arc: then its chord is the edge, as in first-order elements. Edges whose mid-side node is held,
/// and those that elements outside the band share, are left alone.
///
/// Adds a warning that says how many edges and new nodes of the workpiece are beside their surface, curve or tool, how
/// far, and where. False when folded elements remain, or something would be farther off than farthest_straightened.
bool straighten_folded(Workpiece& workpiece);

}  // namespace femscalpel
