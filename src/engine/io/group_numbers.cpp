// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/group_numbers.h"

#include "cancel.h"

namespace femscalpel {

std::vector<std::vector<Index>> group_numbers(const Mesh& mesh) {
    std::vector<std::vector<Index>> out(mesh.groups.size());
    const auto add = [&](FamilyIndex family, Index number) {
        for (const GroupIndex g : mesh.families.groups(family)) out[static_cast<std::size_t>(g)].push_back(number);
    };
    SparseCheck check(1 << 12);
    for (std::size_t n = 0; n < mesh.points.size(); ++n, check()) add(mesh.node_families[n], mesh.node_ids[n]);
    for (const CellBlock& block : mesh.blocks())
        for (std::size_t c = 0; c < block.ids.size(); ++c, check()) add(block.families[c], block.ids[c]);
    return out;
}

}  // namespace femscalpel
