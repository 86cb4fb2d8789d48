// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/emptied_sets.h"

#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace femscalpel {
namespace {

using GroupNames = std::set<std::pair<GroupKind, std::string_view>>;

/// Groups that have a member, but for hidden ones.
GroupNames with_members(const Mesh& mesh) {
    std::vector<char> has(mesh.groups.size(), 0);
    const auto meet = [&](FamilyIndex family, GroupKind kind) {
        for (const GroupIndex g : mesh.families.groups(family)) has[g] = has[g] || mesh.groups[g].kind == kind;
    };
    for (const FamilyIndex f : mesh.node_families) meet(f, GroupKind::node);
    for (const CellBlock& b : mesh.blocks())
        for (const FamilyIndex f : b.families) meet(f, GroupKind::element);
    for (const Facet& f : mesh.facets) meet(f.family, GroupKind::facet);
    GroupNames out;
    for (std::size_t g = 0; g < has.size(); ++g)
        if (has[g] && !mesh.groups[g].hidden) out.emplace(mesh.groups[g].kind, mesh.groups[g].name);
    return out;
}

}  // namespace

EmptiedSets::EmptiedSets(const SolverInput& deck, const Mesh& before, const Mesh& after) {
    const GroupNames had = with_members(before), has = with_members(after);
    for (const DeckSet& set : deck.sets()) {
        const std::pair key(group_kind(set.type), std::string_view(set.group));
        if (set.unheld.empty() && had.contains(key) && !has.contains(key))
            emptied_.emplace(deck_key(set.name), std::string(to_string(set.type)));
    }
}

void EmptiedSets::tell(std::size_t c, const Card& card, int names_per_line, Remarks& remarks) const {
    if (emptied_.empty() || names_per_line == 0) return;
    const auto check = [&](const std::string& where, const std::string& name) {
        if (const auto set = emptied_.find(deck_key(name)); set != emptied_.end())
            remarks.add(c, Weight::problem, where, the_set(name, set->second), "lost all its members");
    };
    for (const CardParameter& p : card.parameters)
        if (p.name == "NSET" || p.name == "ELSET" || p.name == "SURFACE") check(card.where() + ": ", p.value);
    CardReader line(card);
    while (line.next_data_line())
        for (int k = 0; k < names_per_line && !line.at_end(); ++k) check(line.where(), line.field());
}

}  // namespace femscalpel
