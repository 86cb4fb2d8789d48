// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/crop.h"

#include <algorithm>

#include "cancel.h"

namespace femscalpel {

Crop crop(const Mesh& mesh, const CellLists& cells) {
    Crop out;
    Mesh& part = out.mesh;
    part.groups = mesh.groups;
    part.families = mesh.families;
    part.name = mesh.name;
    part.unit = mesh.unit;
    std::vector<Index> place(mesh.points.size(), -1);
    for (const CellBlock& from : mesh.blocks())
        for (const Index c : cells[static_cast<int>(from.type)])
            for (const Index n : from.nodes(c)) place[n] = 0;
    for (std::size_t n = 0; n < place.size(); ++n)
        if (place[n] == 0) {
            place[n] = part.add_node(mesh.points[n], mesh.node_ids[n], mesh.node_families[n]);
            out.nodes.push_back(static_cast<Index>(n));
        }
    for (const CellBlock& from : mesh.blocks()) {
        check_cancelled();
        CellBlock& to = part.block(from.type);
        for (const Index c : cells[static_cast<int>(from.type)]) {
            for (const Index n : from.nodes(c)) to.connectivity.push_back(place[n]);
            to.ids.push_back(from.ids[c]);
            to.families.push_back(from.families[c]);
        }
    }
    for (const Facet& f : mesh.facets) {
        const std::vector<Index>& kept = cells[static_cast<int>(f.type)];
        const auto at = std::ranges::lower_bound(kept, f.cell);
        if (at == kept.end() || *at != f.cell) continue;
        part.facets.push_back(f);
        part.facets.back().cell = at - kept.begin();
    }
    return out;
}

Mesh changed_part(const Mesh& before, const Mesh& after) {
    const NumberIndex numbers(before);
    std::vector<char> changed(after.points.size(), 0);
    for (std::size_t n = 0; n < changed.size(); ++n) {
        const auto old = numbers.node(after.node_ids[n]);
        changed[n] = !old || before.points[*old] != after.points[n];
    }
    CellLists cells;
    for (const CellBlock& b : after.blocks()) {
        SparseCheck check;
        for (Index c = 0; c < b.size(); ++c) {
            check();
            if (!numbers.cell(b.ids[c]) || std::ranges::any_of(b.nodes(c), [&](Index n) { return changed[n] != 0; }))
                cells[static_cast<std::size_t>(b.type)].push_back(c);
        }
    }
    return crop(after, cells).mesh;
}

}  // namespace femscalpel
