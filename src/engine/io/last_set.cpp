// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/last_set.h"

#include <algorithm>

namespace femscalpel {
namespace {

/// Behind all names of ASCII.
constexpr std::string_view last_set_name = "~FEMSCALPEL";

bool is_of_mesh(DeckSetType type) { return type == DeckSetType::nset || type == DeckSetType::elset; }

/// Names are followed by a letter for the type, and compare with blanks behind.
std::string sorting_key(DeckSetType type, std::string_view name) {
    std::string key = deck_key(name);
    key += type == DeckSetType::nset           ? 'N'
           : type == DeckSetType::elset        ? 'E'
           : type == DeckSetType::node_surface ? 'S'
                                               : 'T';
    key.resize(std::max<std::size_t>(key.size(), 81), ' ');
    return key;
}

}  // namespace

void DefinedSets::add(DeckSetType type, std::string_view name, bool has_members, bool by_mesh) {
    definitions_.push_back({type, sorting_key(type, name), has_members, by_mesh});
}

bool DefinedSets::needs_last_set() const {
    std::string last, last_endless;
    bool any_members = false, any_surface = false;
    const auto look = [&](const Definition& d) {
        if (d.has_members && is_of_mesh(d.type)) last = std::max(last, d.key);
        if (!d.has_members && (d.type == DeckSetType::element_surface || (d.by_mesh && !any_members)))
            last_endless = std::max(last_endless, d.key);
        any_members = any_members || d.has_members;
        any_surface = any_surface || d.type == DeckSetType::element_surface;
    };
    for (const DeckSetType type : {DeckSetType::nset, DeckSetType::elset})
        for (const Definition& d : definitions_)
            if (d.by_mesh && d.type == type) look(d);
    for (const Definition& d : definitions_)
        if (!d.by_mesh) look(d);
    return any_surface && last_endless > last;
}

std::string last_set_card(std::string_view node, std::string_view eol) {
    std::string out = "*NODE, NSET=" + std::string(last_set_name);
    out += eol;
    out += "** so that CalculiX does not forget sets without members; FemScalpel leaves it out again";
    out += eol;
    out += node;
    out += eol;
    return out;
}

bool remove_last_set(std::vector<Card>& cards) {
    const auto gone = std::erase_if(cards, [](const Card& card) {
        const std::string* set = card.keyword == "NODE" ? card.parameter("NSET") : nullptr;
        return set && deck_key(*set) == last_set_name;
    });
    return gone > 0;
}

}  // namespace femscalpel
