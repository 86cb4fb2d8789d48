// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/fit_cards.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>

#include "cancel.h"
#include "deck/solver_element.h"
#include "deck/solver_input.h"

namespace femscalpel {
namespace {

/// A card like another, for elements of another type.
Card card_like(const Card& card, const std::string& label, const std::string& group) {
    std::string head = "*" + card.keyword;
    for (const CardParameter& p : card.parameters) {
        head += ", " + p.name;
        if (p.name == "TYPE")
            head += "=" + label;
        else if (!p.value.empty())
            head += "=" + p.value;
    }
    const std::string_view written = card.text.front().text.substr(0, card.head);
    Card out = card;
    out.set_text(head + (written.ends_with("\r\n") ? "\r\n" : "\n"));
    out.group = group;
    return out;
}

class CardFitter {
public:
    explicit CardFitter(Mesh& mesh) : mesh_(mesh), deck_(*solver_input(mesh)) {
        std::unordered_map<std::string_view, std::size_t> cards;
        for (std::size_t c = 0; c < deck_.cards().size(); ++c)
            if (deck_.cards()[c].keyword == "ELEMENT") cards.emplace(deck_.cards()[c].group, c);
        for (std::size_t g = 0; g < mesh.groups.size(); ++g)
            if (const auto card = cards.find(mesh.groups[g].name); mesh.groups[g].hidden && card != cards.end())
                card_of_group_.emplace(static_cast<GroupIndex>(g), card->second);
    }

    void run(std::span<const CellRef> parts) {
        std::map<std::pair<CellType, FamilyIndex>, FamilyIndex> known;
        SparseCheck check(1 << 12);
        for (const CellRef& part : parts) {
            check();
            FamilyIndex& family = mesh_.block(part.type).families[part.cell];
            const auto [place, fresh] = known.try_emplace({part.type, family}, family);
            if (fresh) place->second = fitting(family, part.type);
            family = place->second;
        }
        if (!made_.empty()) insert_cards();
    }

private:
    FamilyIndex fitting(FamilyIndex family, CellType type) {
        for (const GroupIndex g : mesh_.families.groups(family)) {
            const auto card = card_of_group_.find(g);
            if (card == card_of_group_.end()) continue;
            const std::string& label = *deck_.cards()[card->second].parameter("TYPE");
            const std::string fit = deck_label_for(label, type);
            if (fit == deck_key(label)) return family;
            const GroupIndex other = group_for(card->second, fit);
            return mesh_.families.with(mesh_.families.without(family, g), other);
        }
        return family;
    }

    GroupIndex group_for(std::size_t card, const std::string& label) {
        const std::string name = deck_.cards()[card].group + ":" + label;
        if (const auto there = mesh_.find_group(name, GroupKind::element, true)) return *there;
        made_[card].push_back(card_like(deck_.cards()[card], label, name));
        return mesh_.add_group(name, GroupKind::element, true);
    }

    void insert_cards() {
        const auto after = std::make_shared<SolverInput>(deck_);
        std::vector<Card> cards;
        std::vector<std::size_t> place;
        for (std::size_t c = 0; c < deck_.cards().size(); ++c) {
            place.push_back(cards.size());
            cards.push_back(deck_.cards()[c]);
            if (const auto made = made_.find(c); made != made_.end())
                std::ranges::copy(made->second, std::back_inserter(cards));
        }
        after->cards() = std::move(cards);
        for (OtherElement& e : after->other_elements()) e.card = place[e.card];
        mesh_.companion = after;
    }

    Mesh& mesh_;
    const SolverInput& deck_;
    std::unordered_map<GroupIndex, std::size_t> card_of_group_;
    std::map<std::size_t, std::vector<Card>> made_;  // by the card they come behind
};

}  // namespace

void fit_cards(Mesh& mesh, std::span<const CellRef> parts) {
    if (solver_input(mesh)) CardFitter(mesh).run(parts);
}

}  // namespace femscalpel
