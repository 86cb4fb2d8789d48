// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/inner_node.h"

#include <algorithm>
#include <array>
#include <limits>

namespace femscalpel {

int add_inner_node(Workpiece& f, const Vec3& at, const Contact& tools, bool exterior, std::span<const int> near) {
    std::array<int, 2> between{near[0], near[1]};
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (std::size_t a = 0; a < near.size(); ++a)
        for (std::size_t b = a + 1; b < near.size(); ++b) {
            const auto one = f.d.membership.groups(near[a]), other = f.d.membership.groups(near[b]);
            const auto common = static_cast<std::size_t>(
                std::ranges::count_if(one, [&](GroupIndex g) { return std::ranges::find(other, g) != other.end(); }));
            if (common >= fewest) continue;
            fewest = common;
            between = {near[a], near[b]};
        }
    const int node = f.d.add_node(at, between[0], between[1], tools, exterior);
    const double off = tools.has(f.tool) ? 0 : f.tool->distance(at);
    f.distance.push_back(std::abs(off) <= f.tolerance ? 0 : off);
    return node;
}

}  // namespace femscalpel
