// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "operators/options.h"
#include "operators/report.h"

namespace femscalpel {

/// With the option `second_order`: makes the first-order tetrahedra and pyramids that `result` has of converted
/// elements of `input`, one ring of elements around them, and what lies on their faces and edges, second order, with
/// straight edges. The mid-side nodes of edges that elements of first order have, too, are tied to the middle of these
/// by an *EQUATION card, so that both fit. Else, for previews, and where nothing of first order was converted, the
/// result is as it was.
///
/// Throws ToolError when the mesh has no solver's input, which the card would stand in.
Result with_order_raised(const Mesh& input, Result result, const OperatorOptions& options);

}  // namespace femscalpel
