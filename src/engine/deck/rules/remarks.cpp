// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/remarks.h"

#include "words.h"

namespace femscalpel {

std::string Entity::text() const {
    switch (kind) {
        case Kind::node:
            return "node " + std::to_string(number);
        case Kind::element:
            return "element " + std::to_string(number);
        case Kind::set:
            break;
    }
    return type + " '" + name + "'";
}

void Remarks::add(std::size_t card, Weight weight, const std::string& where, const Entity& entity,
                  const std::string& what) {
    Remark& r = remarks_[{card, weight, what}];
    r.keyword = deck_->cards()[card].keyword;
    r.places.push_back({where, entity});
}

std::vector<std::string> Remarks::problems() const {
    std::vector<std::string> out;
    out.reserve(problems_.size());
    for (const Problem& p : problems_) {
        if (p.weight != Weight::problem) continue;
        out.push_back(p.new_nodes.empty()
                          ? p.text
                          : p.text + "new nodes (" + counted(static_cast<std::int64_t>(p.new_nodes.size()), "node") +
                                ", the first is " + std::to_string(*p.new_nodes.begin()) + ") " + p.what);
    }
    for (std::string& text : texts(Weight::problem)) out.push_back(std::move(text));
    return out;
}

std::vector<std::string> Remarks::notes() const {
    std::vector<std::string> out;
    for (const Problem& p : problems_)
        if (p.weight == Weight::note) out.push_back(p.text);
    for (std::string& text : texts(Weight::note)) out.push_back(std::move(text));
    return out;
}

std::vector<std::string> Remarks::texts(Weight weight) const {
    std::vector<std::string> out;
    for (const auto& [key, r] : remarks_) {
        const auto& [card, its_weight, what] = key;
        if (its_weight != weight) continue;
        std::set<std::tuple<Entity::Kind, Index, std::string>> entities;
        for (const Place& p : r.places) entities.insert(p.entity.key());
        const Place& first = r.places.front();
        std::string text = first.where + "*" + r.keyword + " names " + first.entity.text();
        if (entities.size() > 1)
            text += " and " + std::to_string(entities.size() - 1) + " more, each of which " + what;
        else
            text += ", which " + what;
        out.push_back(std::move(text));
    }
    return out;
}

}  // namespace femscalpel
