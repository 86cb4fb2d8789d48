// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <vector>

#include "cutting/cavity.h"

namespace femscalpel {

/// Divides edges inside of what fills a cavity where an element is nearly flat, as some Netgens leave them between four
/// points of the cavity's faces that all but lie in one plane: with a new point off that, what was flat has a volume.
/// The cavity's faces stay. `points`: all of `tetras`; new ones are added behind them.
void mend_filling(std::vector<Vec3>& points, std::span<const Triangle> triangles, std::vector<Tetra>& tetras);

}  // namespace femscalpel
