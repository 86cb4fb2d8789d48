// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/carry_over.h"

#include <algorithm>
#include <set>

#include "cancel.h"
#include "deck/rules/carrying.h"
#include "deck/rules/rules.h"

namespace femscalpel {
namespace {

/// Whether a deck has nothing that would have to follow a change: a mesh with sets, and cards that name neither.
bool is_mesh_alone(const SolverInput& input) {
    const CardRules rules;
    return input.other_elements().empty() &&
           std::ranges::none_of(input.sets(), [](const DeckSet& s) { return s.closed; }) &&
           std::ranges::all_of(input.cards(), [&](const Card& card) {
               const CardRule* rule = rules.find(card);
               return rule && !rule->can_change(card);
           });
}

void carry_cards(Carrying& carrying) {
    const CardRules rules;
    const std::vector<Card>& cards = carrying.old().cards();
    Remarks& remarks = carrying.remarks();
    std::set<std::string> unknown;
    for (const auto& rule : rules.all()) rule->begin_carrying(carrying);
    for (std::size_t c = 0; c < cards.size(); ++c) {
        check_cancelled();
        if (CardRule* rule = rules.find(cards[c])) {
            carrying.emptied_sets().tell(c, cards[c], rule->names_per_line(), remarks);
            rule->carry(c, cards[c], carrying);
        } else if (unknown.insert(cards[c].keyword).second) {
            remarks.add_problem(cards[c].where() + ": *" + cards[c].keyword +
                                " is not a card of CalculiX 2.20: whether it names nodes or elements is not known, so "
                                "it is kept as it is; check it");
        }
    }
    for (const auto& rule : rules.all()) rule->end_carrying(carrying);
}

/// All that has to be told of a deck whose cards stay as they are.
void tell_emptied(const SolverInput& deck, const Mesh& before, const Mesh& after, Remarks& remarks) {
    const EmptiedSets emptied(deck, before, after);
    if (emptied.none()) return;
    const CardRules rules;
    for (std::size_t c = 0; c < deck.cards().size(); ++c)
        emptied.tell(c, deck.cards()[c], rules.find(deck.cards()[c])->names_per_line(), remarks);
}

void pass_on(const Remarks& remarks, bool strict, std::vector<std::string>& warnings) {
    const std::vector<std::string> problems = remarks.problems(), notes = remarks.notes();
    if (strict && !problems.empty()) {
        std::string text = "the solver's input cannot follow the change (strict=True):";
        for (const std::string& problem : problems) text += "\n  " + problem;
        throw Error(text);
    }
    warnings.insert(warnings.end(), problems.begin(), problems.end());
    warnings.insert(warnings.end(), notes.begin(), notes.end());
}

}  // namespace

void carry_deck(const Mesh& before, Mesh& after, const Changes& changes, bool strict,
                std::vector<std::string>& warnings) {
    const SolverInput* const deck = solver_input(before);
    if (!deck) return;
    if (is_mesh_alone(*deck)) {
        Remarks remarks(*deck);
        tell_emptied(*deck, before, after, remarks);
        pass_on(remarks, strict, warnings);
        return;
    }
    Carrying carrying(before, after, changes);
    carry_cards(carrying);
    after.companion = carrying.result();
    pass_on(carrying.remarks(), strict, warnings);
}

}  // namespace femscalpel
