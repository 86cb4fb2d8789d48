// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/group_nodes.h"

#include <algorithm>

namespace femscalpel {

std::vector<char> nodes_of_group(const Mesh& mesh, GroupIndex group) {
    std::vector<char> out(mesh.points.size(), 0);
    for (Index n = 0; n < mesh.node_count(); ++n) out[n] = mesh.families.contains(mesh.node_families[n], group);
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c)
            if (mesh.families.contains(b.families[c], group))
                for (const Index n : b.nodes(c)) out[n] = 1;
    for (const Facet& f : mesh.facets) {
        if (!mesh.families.contains(f.family, group)) continue;
        const CellTraits& t = traits(f.type);
        const auto n = mesh.block(f.type).nodes(f.cell);
        const auto add = [&](std::int8_t k) {
            if (k >= 0) out[n[k]] = 1;
        };
        if (t.dimension == 3)
            std::ranges::for_each(t.faces[f.face - 1], add);
        else if (f.face >= 3)
            std::ranges::for_each(t.edges[f.face - 3], add);
        else
            for (const Index v : n) out[v] = 1;
    }
    return out;
}

}  // namespace femscalpel
