// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "cutting/workpiece.h"

namespace femscalpel {

/// Nodes near the tool that borders of groups inside the material hold.
struct HeldInside {
    std::vector<int> nodes;      ///< band nodes inside the material that stay on a line or where they are
    std::size_t on_borders = 0;  ///< they, and those that stay on a border
    std::size_t inside = 0;      ///< all band nodes inside the material

    /// Borders are everywhere, as those of a group that alternates from element to element.
    bool nearly_all_on_borders() const { return on_borders >= 20 && 2 * on_borders >= inside; }

    /// Groups are scattered through the material: a border of two parts holds only its few corners and lines like that.
    bool many() const { return nodes.size() >= 20 && 5 * nodes.size() >= inside; }
};

/// Of the interface and transition nodes of `f`.
HeldInside held_inside(const Workpiece& f);

}  // namespace femscalpel
