// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/closed_sets.h"

#include <algorithm>

#include "deck/rules/mesh_cards.h"

namespace femscalpel {

ClosedSets::ClosedSets(const DeckView& old, Mesh& after, const NumberIndex& new_numbers, const Changes& changes,
                       SolverInput& input)
    : old_(old), after_(after), new_numbers_(new_numbers), input_(input), sets_(input.sets()) {
    for (const Changes::Born& b : changes.born) new_nodes_.push_back(b.node);
    for (const Changes::Copy& c : changes.copies) new_nodes_.push_back(c.node);
    for (const DeckSet& set : input_.sets()) {
        if (!set.closed) continue;
        const auto group = after_.find_group(set.group, GroupKind::node);
        if (!group) continue;
        for (const Index number : new_nodes_)
            if (const auto node = new_numbers_.node(number)) {
                FamilyIndex& family = after_.node_families[*node];
                family = after_.families.without(family, *group);
            }
    }
}

std::string ClosedSets::name_of_old_members(const std::string& name) {
    const auto group = group_now(name);
    return group && has_new_members(*group) ? closed_set(name, *group) : name;
}

Index ClosedSets::lost_members(std::string_view name) const {
    const auto group = old_.group(DeckSetType::nset, name);
    if (!group) return 0;
    const auto& members = old_.members(*group);
    return std::ranges::count_if(members, [&](Index number) { return !new_numbers_.node(number); });
}

std::optional<GroupIndex> ClosedSets::group_now(std::string_view name) const {
    const auto s = sets_.find(DeckSetType::nset, name);
    return s ? after_.find_group(input_.sets()[*s].group, GroupKind::node) : std::nullopt;
}

bool ClosedSets::has_new_members(GroupIndex group) const {
    return std::ranges::any_of(new_nodes_, [&](Index number) {
        const auto node = new_numbers_.node(number);
        return node && after_.families.contains(after_.node_families[*node], group);
    });
}

std::string ClosedSets::closed_set(const std::string& name, GroupIndex group) {
    if (const auto it = closed_.find(deck_key(name)); it != closed_.end()) return it->second;
    std::string made;
    for (int k = 1;; ++k) {
        made = name.substr(0, 17) + "_LOAD" + std::to_string(k);  // within Code_Aster's 24 characters
        if (!sets_.find(DeckSetType::nset, made) && !after_.find_group(made, GroupKind::node)) break;
    }
    const GroupIndex closed = after_.add_group(made, GroupKind::node);
    std::vector<Index> fresh = new_nodes_;
    std::ranges::sort(fresh);
    for (Index n = 0; n < after_.node_count(); ++n)
        if (after_.families.contains(after_.node_families[n], group) &&
            !std::ranges::binary_search(fresh, after_.node_ids[n]))
            after_.node_families[n] = after_.families.with(after_.node_families[n], closed);
    DeckSet set;
    set.name = set.group = made;
    set.closed = true;
    input_.sets().push_back(std::move(set));
    sets_ = DeckSetIndex(input_.sets());
    closed_.emplace(deck_key(name), made);
    return made;
}

void ClosedSets::define() {
    if (closed_.empty()) return;
    std::vector<Card>& cards = input_.cards();
    std::size_t at = 0;
    for (std::size_t c = 0; c < cards.size(); ++c)
        if (is_mesh_card(cards[c])) at = c + 1;
    for (const auto& [key, name] : closed_) {
        Card card;
        card.set_text("*NSET, NSET=" + name + "\n");
        cards.insert(cards.begin() + static_cast<std::ptrdiff_t>(at++), std::move(card));
    }
}

}  // namespace femscalpel
