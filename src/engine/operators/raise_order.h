// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "operators/options.h"
#include "operators/report.h"

namespace femscalpel {

/// With the option `second_order`: makes the first-order tetrahedra and pyramids that `result` has of converted
/// elements of `input`, one ring of elements around them, and what lies on their faces and edges, second order, with
/// straight edges. The mid-side nodes of edges that elements of first order have, too, are tied to the middle of these
/// by an *EQUATION card (deck/edge_ties.h), so that both fit. Else, for previews, and where nothing of first order was
/// converted, the result is as it was.
///
/// In any case, tells of the ties of edges in the result (tell_of_ties()).
///
/// Throws ToolError when the mesh has no solver's input, which the card would stand in.
Result with_order_raised(const Mesh& input, Result result, const OperatorOptions& options);

/// Adds what does not work out with the ties of edges (problems_of_ties()) in a result, and did not in the input,
/// to its warnings. With `strict`, throws Error instead.
void tell_of_ties(const Mesh& input, bool strict, Result& result);

}  // namespace femscalpel
