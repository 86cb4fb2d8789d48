// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/edge_beams.h"

#include <string>

namespace femscalpel {

namespace {

template <class Which>
void mark_segments(Mesh& mesh, Which which) {
    const std::string name(edge_beams_group);
    const auto known = mesh.find_group(name, GroupKind::element, true);
    const GroupIndex beams = known ? *known : mesh.add_group(name, GroupKind::element, true);
    for (const CellType type : {CellType::line, CellType::line3})
        for (FamilyIndex& family : mesh.block(type).families)
            if (which(family)) family = mesh.families.with(family, beams);
}

}  // namespace

void mark_edge_beams(Mesh& mesh, GroupIndex of) {
    mark_segments(mesh, [&](FamilyIndex family) { return mesh.families.contains(family, of); });
}

void mark_edge_beams(Mesh& mesh) {
    if (mesh.block(CellType::line).size() + mesh.block(CellType::line3).size() == 0) return;
    mark_segments(mesh, [](FamilyIndex) { return true; });
}

}  // namespace femscalpel
