// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cutting/bisection.h"
#include "deck/rules/remarks.h"
#include "mesh/changes.h"
#include "operators/changed_quality.h"
#include "operators/refine_estimate.h"
#include "operators/report.h"

namespace femscalpel {

/// What the user of refine() can choose.
struct RefineOptions : BisectionOptions {
    double feature_angle = 30;  ///< degrees; a skin edge sharper than this is a feature line
    bool strict = false;        ///< Error instead of warnings where the solver's input cannot follow (carry_over.h)
    BeforeRefining before;      ///< told what it will come to, if anything is to be refined; may throw
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
/// Where quadrangles, prisms, pyramids or hexahedra have edges to be bisected, what of them is near becomes triangles
/// and tetrahedra first (simplify()).
///
/// Throws ToolError (an option out of range, more than max_elements), UnsupportedElementError (an element of so poor a
/// shape that it cannot be converted), QualityError (inverted elements near the tool).
Result refine(const Mesh& mesh, const DistanceField& distance, const RefineOptions& options);

/// Level 0 at the corners of elements (or of those alone that are no simplices) that have an edge longer than wanted,
/// -1 elsewhere.
std::vector<std::int8_t> corners_of_long_edges(const Mesh& mesh, const DistanceField& distance,
                                               const BisectionOptions& options, bool no_simplices = false);

/// What an operation has to know of a refinement that it goes on from.
struct Trace {
    /// Numbers, ascending, of new nodes inside the material that are in node groups: those of edges from member to
    /// member that are on no boundary of the group. (Who goes on with the result alone does not know them: to an
    /// operation on it they are members like any other, whose place is kept.)
    std::vector<Index> on_shortcuts;
    Changes changes;
    ChangedQuality quality;  ///< of elements that were divided or converted, and of what became of them
    Remarks deck;            ///< on how the solver's input followed
};

/// The same of triangles and tetrahedra alone, but nothing when no edge is longer than wanted; and what is to be told
/// of the solver's input is in `trace`, not in the report, nor an error with the option strict.
std::optional<Result> refine_where_needed(const Mesh& mesh, const DistanceField& distance, const RefineOptions& options,
                                          Trace& trace);

}  // namespace femscalpel
