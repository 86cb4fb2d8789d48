// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/deck_view.h"

#include <algorithm>

namespace femscalpel {

DeckView::DeckView(const Mesh& mesh)
    : mesh_(mesh),
      input_(*solver_input(mesh)),
      numbers_(mesh),
      sets_(input_.sets()),
      planes_(plane_families(mesh, input_)) {
    int step = 0, steps = 0;
    for (const Card& card : cards()) {
        if (card.keyword == "STEP") step = ++steps;
        steps_.push_back(step);
        if (card.keyword == "ENDSTEP") step = 0;
    }
}

std::optional<GroupIndex> DeckView::group(DeckSetType type, std::string_view name) const {
    const auto s = sets_.find(type, name);
    if (!s) return {};
    return mesh_.find_group(input().sets()[*s].group, group_kind(type));
}

const std::vector<Index>& DeckView::members(GroupIndex group) const {
    const auto [it, fresh] = members_.try_emplace(group);
    if (fresh) it->second = group_members(mesh_, group).ids;
    return it->second;
}

std::optional<NumberOrSet> read_number_or_set(CardReader& line) {
    NumberOrSet out;
    if (line.integer(out.number)) return out;
    out.set = line.field();
    if (out.set.empty()) return {};
    return out;
}

std::optional<NumberOrSet> next_entry(CardReader& line) {
    while (line.next_data_line())
        if (auto what = read_number_or_set(line)) return what;
    return {};
}

std::vector<NumberOrSet> read_entries(CardReader& line) {
    std::vector<NumberOrSet> out;
    while (!line.at_end())
        if (auto what = read_number_or_set(line)) out.push_back(std::move(*what));
    return out;
}

std::string type_of(const Card& card) {
    const std::string* type = card.parameter("TYPE");
    return type ? deck_key(*type) : "";
}

std::string parameters_key(const Card& card) {
    std::string key = card.keyword;
    for (const CardParameter& p : card.parameters)
        if (p.name != "OP") key += "," + p.name + "=" + deck_key(p.value);
    return key;
}

}  // namespace femscalpel
