// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "cutting/workpiece.h"
#include "deformation/curved_shape.h"

namespace femscalpel {

/// Second-order elements with a smaller curved_ratio() are as good as folded.
inline constexpr double least_curved = 0.02;

/// Second-order elements of the band that were changed and are nearly or really folded (curved_ratio() below `limit`),
/// worst first.
std::vector<BandElement> folded_elements(const Workpiece& f, double limit);

/// Improves second-order elements that came out nearly folded, one after the other: mid-side nodes give up the place
/// the input had them at along their edge, corner nodes move within their constraints, and edges that bulge far from
/// their chord are bisected, if `may_split`. Elements that were sound stay so; some may remain folded.
void mend_curved(Workpiece& f, bool may_split = true);

}  // namespace femscalpel
