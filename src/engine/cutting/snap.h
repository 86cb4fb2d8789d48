// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "cutting/workpiece.h"

namespace femscalpel {

/// Makes element faces (edges of shells) lie on a blade, where it is wanted: nodes near it are moved onto it along
/// their constraints, nearest first; edges that still cross are bisected on it, longest first. Elements are not
/// relaxed.
void cut_along(Workpiece& workpiece, const Blade& blade);

/// Puts a node in contact with a tool that it lies on but for the rounding of coordinates. Where something holds it (a
/// border, a corner, a card of the deck) it leaves that by as much as rounding allows.
void put_on_tool(Workpiece& workpiece, int node, const Tool& tool);

/// Whether a node is so near a tool, `distance` away, that no element should come to lie between them: then it is on
/// the tool, held beside it where it cannot be moved there (Deformable::hold_beside()). `reach`: how far the elements
/// around it reach to the tool's other side; up to the part `part` of that it is.
inline bool is_beside(double distance, double reach, double part) { return std::abs(distance) <= part * reach; }

/// The method `snap` (resources/docs/architecture.md): nodes near the tool are moved onto it along their constraints,
/// nearest first; edges that still cross are bisected on it, longest first; then the band is relaxed.
void snap_to_tool(Workpiece& workpiece, const Blade& blade, Index mesh_elements);

}  // namespace femscalpel
