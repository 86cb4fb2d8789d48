// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/deformation.h"

#include "deformation/bar_network.h"
#include "deformation/curved_shape.h"
#include "deformation/relaxation.h"

namespace femscalpel {

void deform(Deformable& d, const std::vector<int>& interface, const std::vector<int>& transition) {
    std::vector<Vec3> given;
    given.reserve(interface.size());
    for (const int v : interface) given.push_back(d.band.nodes[v].at - d.band.nodes[v].start);
    const std::vector<Vec3> spread = bar_network_displacements(d, interface, given, transition);
    for (std::size_t k = 0; k < transition.size(); ++k) {
        const int v = transition[k];
        if (spread[k].isZero() || !quality_around_is_below(0.5, d, v)) continue;
        Vec3 x = d.band.nodes[v].at + spread[k];
        if (!d.constraints.project(v, d.contact[v], x) || d.is_barred(v, x)) continue;
        // Node by node the displacement is only right once all have moved, so a loss is tolerated while
        // elements stay sound.
        if (quality_around(d, v, x) > quality_around(d, v, d.band.nodes[v].at) && keeps_curved_shape(d, v, x))
            d.band.nodes[v].at = x;
    }
    std::vector<int> movable = interface;
    movable.insert(movable.end(), transition.begin(), transition.end());
    relax(d, movable);
}

}  // namespace femscalpel
