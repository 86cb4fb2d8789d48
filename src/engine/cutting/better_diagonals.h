// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <utility>
#include <vector>

#include "cutting/conversion.h"

namespace femscalpel {

/// Other diagonals for quadrangular faces of solids that came out poor, one of which makes good tetrahedra where the
/// diagonals that are best for each face alone do not: the poorest first, for each the choice by which it and the
/// solids across the changed faces are best. Looks at corners alone; takes time for each, so only for some of them.
///
/// `poor`: solids of `conversion` with the quality they came out with. Returns the diagonals by face, those that are to
/// change; conversion.diagonals stay where nothing better was found.
QuadTable<QuadDiagonal> better_diagonals(const Mesh& mesh, const Conversion& conversion,
                                         std::vector<std::pair<double, CellRef>> poor);

}  // namespace femscalpel
