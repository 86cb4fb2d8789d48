// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mesh/mesh.h"
#include "operators/report.h"
#include "tools/cad_shape.h"
#include "tools/tool.h"

namespace femscalpel {

/// Distance from a point to what a mesh is refined around, in the mesh's unit. May be signed: an edge whose ends
/// have different signs is at distance 0.
using DistanceField = std::function<double(const Vec3&)>;

/// Distance to the nearest of some tools, which must outlive the field. Throws ToolError when there is none.
DistanceField distance_to(std::vector<const Tool*> tools);

/// Distance to the nearest of some points. Throws ToolError when there is none or one is not finite.
DistanceField distance_to(std::vector<Vec3> points);

/// What the user of refine() can choose.
struct RefineOptions {
    double size = 0;                 ///< longest edge wanted near the tool, in the mesh's unit
    double gradation = 0.5;          ///< how much longer edges may be per unit of distance from the tool
    double reach = 0;                ///< `size` holds up to this distance, and grows from there
    bool relax = true;               ///< move new nodes for better shape, where that changes no surface or border
    Index max_elements = 5'000'000;  ///< ToolError instead of a larger mesh
    double feature_angle = 30;       ///< degrees; a skin edge sharper than this is a feature line
    const CadShape* skin = nullptr;  ///< the shape the mesh was made from: new nodes of the skin are put on it
    bool strict = false;  ///< Error instead of warnings where the solver's input cannot follow (carry_over.h)
};

/// Bisects edges until none is longer than size + gradation * max(0, d - reach), d the smallest distance of
/// its ends and middle: the refinement the paper's conclusion asks for before a tool finer than the mesh.
///
/// Triangles and tetrahedra, linear and quadratic, with the segments, triangles and facets on them. The longest
/// edge goes first, and an edge is only bisected when it is the longest of all elements around it; otherwise
/// theirs go first (Rivara, "New longest-edge algorithms for the refinement and/or improvement of unstructured
/// triangulations", Int. J. Numer. Meth. Engng. 40 (1997)), which keeps shapes from degenerating. Beams and
/// springs (segments on no triangle or tetrahedron) are not bisected.
///
/// No node of the input moves. Children inherit the groups of their parent, a new node those both ends of its edge
/// are in. Parts of a curved second-order element are that element's own exact geometry; a mid-side node of a
/// bisected edge becomes the corner. Measures of groups do not change; with `skin`, those of curved ones get better.
///
/// Throws ToolError (an option out of range, more than max_elements), UnsupportedElementError (an edge to be
/// bisected is one of a quadrangle, prism, pyramid or hexahedron), QualityError (inverted elements near the tool).
Result refine(const Mesh& mesh, const DistanceField& distance, const RefineOptions& options);

/// The same, but nothing when no edge is longer than wanted. `on_shortcuts` gets the numbers, ascending, of new nodes
/// inside the material that are in node groups: those of edges from member to member that are on no boundary of the
/// group. (Who goes on with the result alone does not know them: to an operation on it they are members like any other,
/// whose place is kept.)
std::optional<Result> refine_where_needed(const Mesh& mesh, const DistanceField& distance, const RefineOptions& options,
                                          std::vector<Index>& on_shortcuts);

}  // namespace femscalpel
