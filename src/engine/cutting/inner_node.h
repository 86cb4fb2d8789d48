// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include "cutting/workpiece.h"

namespace femscalpel {

/// Adds a node that is on no edge to the band and returns it. It is in the node groups which two of `near`, the nodes
/// of an element or face where it lies, have in common: those two that have fewest. On the skin (`exterior`) it stays
/// where it is.
int add_inner_node(Workpiece& workpiece, const Vec3& at, const Contact& tools, bool exterior,
                   std::span<const int> near);

}  // namespace femscalpel
