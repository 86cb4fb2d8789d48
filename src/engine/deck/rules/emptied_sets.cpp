// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/emptied_sets.h"

#include <vector>

namespace femscalpel {
namespace {

/// By group: whether it has a member.
std::vector<char> with_members(const Mesh& mesh) {
    std::vector<char> out(mesh.groups.size(), 0);
    const auto meet = [&](FamilyIndex family, GroupKind kind) {
        for (const GroupIndex g : mesh.families.groups(family)) out[g] = out[g] || mesh.groups[g].kind == kind;
    };
    for (const FamilyIndex f : mesh.node_families) meet(f, GroupKind::node);
    for (const CellBlock& b : mesh.blocks())
        for (const FamilyIndex f : b.families) meet(f, GroupKind::element);
    for (const Facet& f : mesh.facets) meet(f.family, GroupKind::facet);
    return out;
}

}  // namespace

EmptiedSets::EmptiedSets(const SolverInput& deck, const Mesh& before, const Mesh& after) {
    const std::vector<char> had = with_members(before), has = with_members(after);
    for (const DeckSet& set : deck.sets()) {
        const auto was = before.find_group(set.group, group_kind(set.type)),
                   is = after.find_group(set.group, group_kind(set.type));
        if (set.unheld.empty() && was && had[*was] && (!is || !has[*is]))
            emptied_.emplace(deck_key(set.name), std::string(to_string(set.type)));
    }
}

void EmptiedSets::tell(std::size_t c, const Card& card, int names_per_line, Remarks& remarks) const {
    if (emptied_.empty() || names_per_line == 0) return;
    const auto check = [&](const std::string& where, const std::string& name) {
        if (const auto set = emptied_.find(deck_key(name)); set != emptied_.end())
            remarks.add(c, Weight::problem, where, set->second + " '" + name + "'", "lost all its members");
    };
    for (const CardParameter& p : card.parameters)
        if (p.name == "NSET" || p.name == "ELSET" || p.name == "SURFACE") check(card.where() + ": ", p.value);
    CardReader line(card);
    while (line.next_data_line())
        for (int k = 0; k < names_per_line && !line.at_end(); ++k) check(line.where(), line.field());
}

}  // namespace femscalpel
