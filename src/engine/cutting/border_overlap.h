// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "deformation/deformable.h"

namespace femscalpel {

/// Where the border of a band's shells lies on itself: a node on an edge that it is no end of, or at the place of
/// another. The two sides are not joined there, though no element is folded: lips of a crack, or a slit that should not
/// be.
std::optional<Vec3> border_overlap(const Deformable& d);

}  // namespace femscalpel
