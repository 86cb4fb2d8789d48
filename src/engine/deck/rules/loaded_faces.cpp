// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/loaded_faces.h"

#include <algorithm>

#include "cancel.h"
#include "deck/mark_deck.h"
#include "groups/group_report.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

/// Area or volume of a marked group.
double measure_of(const Mesh& mesh, const std::string& group) {
    const std::string name = std::string(mark_prefix) + group;
    double sum = 0;
    if (const auto g = mesh.find_group(name, GroupKind::facet, true)) {
        for (const Facet& f : mesh.facets)
            if (mesh.families.contains(f.family, *g)) sum += facet_measure(mesh, f);
    } else if (const auto e = mesh.find_group(name, GroupKind::element, true)) {
        SparseCheck check;
        for (const CellBlock& b : mesh.blocks())
            for (Index c = 0; c < b.size(); ++c, check())
                if (mesh.families.contains(b.families[c], *e)) sum += cell_measure(mesh, b.type, c);
    }
    return sum;
}

}  // namespace

LoadedFaces::LoadedFaces(const Mesh& before, const Mesh& after) : before_(before), after_(after) {
    std::vector<Faces*> of_group(after.groups.size(), nullptr);
    bool any = false;
    for (std::size_t g = 0; g < of_group.size(); ++g) {
        const Group& group = after.groups[g];
        if (!group.hidden || group.kind == GroupKind::node || !group.name.starts_with(mark_prefix)) continue;
        of_group[g] = &now_[group.name.substr(mark_prefix.size())];
        any = true;
    }
    if (!any) return;
    SparseCheck check;
    for (const CellBlock& b : after.blocks())
        for (Index c = 0; c < b.size(); ++c, check())
            for (const GroupIndex g : after.families.groups(b.families[c]))
                if (of_group[g]) of_group[g]->push_back({b.ids[c], 0});
    for (const Facet& f : after.facets)
        for (const GroupIndex g : after.families.groups(f.family))
            if (of_group[g]) of_group[g]->push_back({after.block(f.type).ids[f.cell], f.face});
    for (auto& [name, faces] : now_) std::ranges::sort(faces);
}

const Faces& LoadedFaces::now(const std::string& group) const {
    static const Faces none;
    const auto it = now_.find(group);
    return it == now_.end() ? none : it->second;
}

bool LoadedFaces::shrank(const std::string& group) {
    const auto [it, fresh] = shrank_.try_emplace(group);
    if (fresh) it->second = measure_of(after_, group) < (1 - 1e-9) * measure_of(before_, group);
    return it->second;
}

}  // namespace femscalpel
