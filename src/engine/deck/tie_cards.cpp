// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/tie_cards.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "deck/model_end.h"
#include "deck/solver_sets.h"

namespace femscalpel {
namespace {

/// The thickness a *SHELL SECTION gives; of a composite that of all layers.
double thickness_of(const Card& card) {
    double sum = 0;
    CardReader line(card);
    while (line.next_data_line()) {
        double value = 0;
        if (!line.number(value)) break;
        sum += value;
        if (!card.parameter("COMPOSITE")) break;
    }
    return sum;
}

}  // namespace

std::optional<double> half_thickness(const Mesh& mesh, GroupIndex facets) {
    const SolverInput* const deck = solver_input(mesh);
    std::vector<std::pair<GroupIndex, double>> sections;
    if (deck) {
        const DeckSetIndex sets(deck->sets());
        for (const Card& card : deck->cards()) {
            const std::string* elset = card.parameter("ELSET");
            if (card.keyword != "SHELLSECTION" || !elset) continue;
            const auto set = sets.find(DeckSetType::elset, *elset);
            if (const auto g = set ? mesh.find_group(deck->sets()[*set].group, GroupKind::element) : std::nullopt)
                sections.push_back({*g, thickness_of(card)});
        }
    }
    double largest = 0;
    for (const Facet& f : mesh.facets) {
        if (!mesh.families.contains(f.family, facets) || traits(f.type).dimension != 2) continue;
        const FamilyIndex family = mesh.block(f.type).families[f.cell];
        // The last card counts.
        const auto section = std::find_if(sections.rbegin(), sections.rend(),
                                          [&](const auto& s) { return mesh.families.contains(family, s.first); });
        if (section == sections.rend()) return {};
        largest = std::max(largest, section->second);
    }
    return largest / 2;
}

std::string tie_card(const Tie& tie) {
    char tolerance[32];
    std::snprintf(tolerance, sizeof tolerance, "%.6g", tie.tolerance);
    return "*TIE, NAME=" + tie.name + ", POSITION TOLERANCE=" + tolerance + "\n" + tie.slave + ", " + tie.master + "\n";
}

void add_tie(Mesh& mesh, const Tie& tie) {
    const SolverInput* const old = solver_input(mesh);
    if (!old) return;
    auto deck = std::make_shared<SolverInput>(*old);
    std::vector<Card> cards;
    for (const std::string& surface : {tie.slave, tie.master}) {
        DeckSet set;
        set.type = DeckSetType::element_surface;
        set.name = set.group = surface;
        deck->sets().push_back(std::move(set));
        cards.emplace_back().set_text("*SURFACE, NAME=" + surface + ", TYPE=ELEMENT\n");
    }
    cards.emplace_back().set_text(tie_card(tie));
    add_to_model(*deck, std::move(cards));
    mesh.companion = std::move(deck);
}

}  // namespace femscalpel
