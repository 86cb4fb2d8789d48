// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "operators/merge.h"

namespace femscalpel {

/// What merge() does with `options.tie`: both meshes stay as they are, and the faces with which they touch are facet
/// groups, `name`_TIE_MESH and `name`_TIE_ADDED (touching_faces()). A CalculiX deck of the mesh gets the *SURFACE and
/// *TIE cards that hold them together. Master is the coarser side, or, where a shell stands on its edge, the other;
/// the edge's facets carry moments, as nodes alone would not.
///
/// Throws ToolError when the two do not touch, or overlap.
Result tie(const Mesh& mesh, const Mesh& addition, const MergeOptions& options);

}  // namespace femscalpel
