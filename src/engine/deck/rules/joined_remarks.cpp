// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/joined_remarks.h"

#include <algorithm>

#include "deck/card_edits.h"

namespace femscalpel {
namespace {

bool has_carried_lines(const SolverInput& deck) {
    return std::ranges::any_of(deck.cards(), [](const Card& card) {
        return std::ranges::any_of(card.text, [](const DeckText& t) { return t.file->carried; });
    });
}

void strip(std::string& text) {
    if (const std::size_t at = text.find(carried_over); at != text.npos) text.erase(at, carried_over.size());
}

Index parent_in(const std::unordered_map<Index, Index>& parents, Index element) {
    const auto parent = parents.find(element);
    return parent == parents.end() ? element : parent->second;
}

}  // namespace

JoinedRemarks::JoinedRemarks(Remarks first, const Changes& first_changes, Remarks second, const Changes& second_changes,
                             const Mesh& after, const SolverInput& input)
    : first_(std::move(first)), second_(std::move(second)) {
    if (first_.empty() && second_.empty()) return;
    nodes_.insert(after.node_ids.begin(), after.node_ids.end());
    for (Remarks::Problem& p : first_.problems_) {
        if (p.new_nodes.empty()) continue;
        std::erase_if(p.new_nodes, [&](Index n) { return !nodes_.contains(n); });
        if (p.new_nodes.empty()) p.text.clear();
    }
    std::erase_if(first_.problems_, [](const Remarks::Problem& p) { return p.text.empty(); });
    if (second_.empty()) return;
    for (const Changes::Born& b : first_changes.born) born_.insert(b.node);
    for (const Changes::Copy& c : first_changes.copies) born_.insert(c.node);
    for (const Changes::Part& p : first_changes.parts) parents_.emplace(p.element, p.parent);
    std::unordered_map<Index, Index> later;
    for (const Changes::Part& p : second_changes.parts) later.emplace(p.element, p.parent);
    for (const CellBlock& b : after.blocks())
        for (const Index id : b.ids) {
            const Index between = parent_in(later, id);
            present_.insert(between);
            left_.insert(parent_in(parents_, between));
        }
    translate_second(!has_carried_lines(input));
}

void JoinedRemarks::translate_second(bool strip_places) {
    for (auto& [key, remark] : second_.remarks_) {
        std::erase_if(remark.places, [&](Remarks::Place& p) { return !keep(p); });
        if (strip_places)
            for (Remarks::Place& p : remark.places) strip(p.where);
    }
    std::erase_if(second_.remarks_, [](const auto& r) { return r.second.places.empty(); });
    if (strip_places)
        for (Remarks::Problem& p : second_.problems_) strip(p.text);
}

bool JoinedRemarks::keep(Remarks::Place& place) {
    Entity& entity = place.entity;
    switch (entity.kind) {
        case Entity::Kind::node:
            return nodes_.contains(entity.number) || !born_.contains(entity.number);
        case Entity::Kind::element: {
            const bool removed = !present_.contains(entity.number);
            entity.number = parent_in(parents_, entity.number);
            return !removed || !left_.contains(entity.number);
        }
        case Entity::Kind::set:
            if (const auto set = first_.replaced_.find(deck_key(entity.name)); set != first_.replaced_.end())
                entity.name = set->second;
            return true;
    }
    return true;
}

}  // namespace femscalpel
