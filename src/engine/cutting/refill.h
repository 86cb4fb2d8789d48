// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "cutting/crossed_borders.h"
#include "mesh/changes.h"
#include "mesh/surface.h"

namespace femscalpel {

/// A solid that was fitted to the skin of another.
struct Refilled {
    Mesh mesh;                   ///< numbers of what is new follow those in use; nodes of the other's skin are among it
    std::vector<Index> partner;  ///< by node: the node of the other that it is, or -1
    Index taken = 0;             ///< tetrahedra that were taken out
    double worst = 1;            ///< smallest mean ratio of these
    std::vector<CellRef> added;  ///< these
    Changes changes;             ///< which element taken out was nearest to each
    CrossedBorders borders;      ///< of groups, that ran through what was taken out
};

/// Fits a solid to a part of the skin of another: takes out its tetrahedra that reach there, or inside the other, and
/// fills the cavity between that skin, what is left of its own, and what is left of the solid (fill_cavity()). Nothing
/// else changes. What is new has the groups of the nearest element that was taken out; facets and elements on what is
/// left of the skin stay.
///
/// `partner`, by node of `mesh`: the node of `other` it is, or -1; both have all edges of the outline of the part.
/// `covered`: the faces of `mesh` behind the part; `cover`: the part, faces of `other`.
/// Throws QualityError that names the place when the cavity is not sound or cannot be filled.
Refilled refill(const Mesh& mesh, const Mesh& other, const std::vector<Index>& partner,
                const std::vector<SurfaceFace>& covered, const std::vector<SurfaceFace>& cover);

}  // namespace femscalpel
