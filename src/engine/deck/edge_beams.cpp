// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/edge_beams.h"

#include <string>

namespace femscalpel {

void mark_edge_beams(Mesh& mesh, GroupIndex of) {
    const std::string name(edge_beams_group);
    const auto known = mesh.find_group(name, GroupKind::element, true);
    const GroupIndex beams = known ? *known : mesh.add_group(name, GroupKind::element, true);
    for (const CellType type : {CellType::line, CellType::line3})
        for (FamilyIndex& family : mesh.block(type).families)
            if (mesh.families.contains(family, of)) family = mesh.families.with(family, beams);
}

}  // namespace femscalpel
