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

std::vector<std::pair<std::string, Index>> reference_nodes(const Card& card) {
    std::vector<std::pair<std::string, Index>> out;
    const auto look = [&](std::string_view parameter, std::string_view written) {
        const std::string* value = card.parameter(parameter);
        if (!value || value->empty() || !std::ranges::all_of(*value, [](char c) { return c >= '0' && c <= '9'; }))
            return;
        if (value->size() <= 18) out.emplace_back(written, std::stoll(*value));
    };
    if (card.keyword == "RIGIDBODY" || card.keyword == "COUPLING") {
        look("REFNODE", "REF NODE");
        look("ROTNODE", "ROT NODE");
    } else if (card.keyword == "PRE-TENSIONSECTION") {
        look("NODE", "NODE");
    }
    return out;
}

std::string parameters_key(const Card& card) {
    std::string key = card.keyword;
    for (const CardParameter& p : card.parameters)
        if (p.name != "OP") key += "," + p.name + "=" + deck_key(p.value);
    return key;
}

namespace {

std::string mark(std::string_view kind, std::size_t card, const LoadLabel& label, std::string_view rest) {
    return std::string(mark_prefix) + std::string(kind) + std::to_string(card) + ":" + label.prefix + "#" +
           label.suffix + "," + deck_key(rest);
}

}  // namespace

std::string face_mark(std::size_t card, const LoadLabel& label, std::string_view rest) {
    return mark("FACES", card, label, rest);
}

std::string element_mark(std::size_t card, const LoadLabel& label, std::string_view rest) {
    return mark("ELEMENTS", card, label, rest);
}

}  // namespace femscalpel
