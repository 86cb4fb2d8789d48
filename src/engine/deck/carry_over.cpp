// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/carry_over.h"

#include <algorithm>
#include <iterator>
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

/// What is not there yet.
void append(std::vector<std::string>& out, std::vector<std::string> texts) {
    for (std::string& text : texts)
        if (std::ranges::find(out, text) == out.end()) out.push_back(std::move(text));
}

std::vector<std::string> pass_on(std::vector<std::string> problems, std::vector<std::string> notes, bool strict) {
    if (strict && !problems.empty()) {
        std::string text = "the solver's input cannot follow the change (strict=True):";
        for (const std::string& problem : problems) text += "\n  " + problem;
        throw Error(text);
    }
    std::ranges::move(notes, std::back_inserter(problems));
    return problems;
}

}  // namespace

Remarks carry_deck(const Mesh& before, Mesh& after, const Changes& changes) {
    const SolverInput* const deck = solver_input(before);
    if (!deck) return {};
    if (is_mesh_alone(*deck)) {
        Remarks remarks(*deck);
        tell_emptied(*deck, before, after, remarks);
        return remarks;
    }
    Carrying carrying(before, after, changes);
    carry_cards(carrying);
    after.companion = carrying.result();
    return carrying.remarks();
}

std::vector<std::string> warnings_of(const Remarks& remarks, bool strict) {
    return pass_on(remarks.problems(), remarks.notes(), strict);
}

std::vector<std::string> warnings_of(const JoinedRemarks& remarks, bool strict) {
    std::vector<std::string> problems = remarks.first().problems(), notes = remarks.first().notes();
    append(problems, remarks.second().problems());
    append(notes, remarks.second().notes());
    return pass_on(std::move(problems), std::move(notes), strict);
}

}  // namespace femscalpel
