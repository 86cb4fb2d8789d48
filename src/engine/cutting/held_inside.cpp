// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/held_inside.h"

namespace femscalpel {

HeldInside held_inside(const Workpiece& f) {
    HeldInside out;
    for (const auto* set : {&f.nodes, &f.transition})
        for (const int v : *set) {
            if (f.d.constraints.is_exterior(v)) continue;
            ++out.inside;
            const NodeFreedom freedom = f.d.constraints[v].freedom;
            out.on_borders += freedom != NodeFreedom::free;
            if (freedom == NodeFreedom::fixed || freedom == NodeFreedom::curve) out.nodes.push_back(v);
        }
    return out;
}

}  // namespace femscalpel
