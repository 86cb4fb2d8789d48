// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/carry_over.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "cancel.h"
#include "deck/deck_view.h"
#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"
#include "deck/rules/nameless_cards.h"
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

/// Whether a line or parameter of a card has a number that is one of a node or an element of the mesh.
bool may_name_entities(const Card& card, const DeckView& view) {
    const auto is_one = [&](Index number) {
        return view.numbers().node(number).has_value() || view.numbers().cell(number).has_value();
    };
    for (const CardParameter& p : card.parameters)
        if (p.name.find("NODE") != p.name.npos || p.name.find("ELEMENT") != p.name.npos) {
            const auto number = deck_number(p.value);
            if (number && is_one(static_cast<Index>(*number))) return true;
        }
    CardReader line(card);
    while (line.next_data_line())
        while (!line.at_end())
            if (Index number = 0; line.integer(number)) {
                if (is_one(number)) return true;
            } else {
                line.field();
            }
    return false;
}

/// A card that CalculiX does not have, or not yet, as far as the rules know; `told` says of which kinds that is told.
void tell_unknown(const Card& card, const Carrying& carrying, Remarks& remarks, std::set<std::string>& told) {
    const bool may_name = !is_nameless_in_abaqus(card.keyword) && may_name_entities(card, carrying.old());
    if (!told.insert((may_name ? "1" : "0") + card.keyword).second) return;
    const std::string text =
        card.where() + ": *" + card.keyword + " is not a card of CalculiX up to " + std::string(latest_calculix) + ": ";
    if (may_name)
        remarks.add_problem(text + "whether it names nodes or elements is not known, so it is kept as it is; check it");
    else
        remarks.add_note(text + "it names no node or element by number and is kept as it is");
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
        } else {
            tell_unknown(cards[c], carrying, remarks, unknown);
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

/// A solver that refused a number above the largest in use passes over it once new numbers are above it.
void tell_absent(const Mesh& before, const Mesh& after, Remarks& remarks) {
    const SolverInput& deck = *solver_input(before);
    const auto between = [](Index number, Index low, Index high) { return low < number && number <= high; };
    const Index node = before.largest_node_id(), new_node = after.largest_node_id();
    const Index cell = before.largest_cell_id(), new_cell = after.largest_cell_id();
    if (!between(deck.largest_other_node(), node, new_node) && !between(deck.largest_other_element(), cell, new_cell))
        return;
    const AbsentNumbers absent(before, deck);
    for (const AbsentNumbers::OfCard& named : absent.all())
        if (std::ranges::any_of(named.numbers, [&](Index number) {
                return named.node ? between(number, node, new_node) : between(number, cell, new_cell);
            }))
            remarks.add_problem(named.where + named_text(named, deck.cards()[named.card]) +
                                " that the deck does not define: CalculiX refused that, and passes over it now that "
                                "there are larger numbers; correct the line");
}

/// New nodes and elements of further operators must not get numbers that cards of the changed deck name.
void keep_absent(Mesh& after) {
    const SolverInput& deck = *solver_input(after);
    const AbsentNumbers absent(after, deck);
    if (absent.largest_node() == deck.largest_other_node() && absent.largest_element() == deck.kept_element()) return;
    const auto changed = std::make_shared<SolverInput>(deck);
    changed->keep_numbers(absent.largest_node(), absent.largest_element());
    after.companion = changed;
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
    tell_absent(before, after, carrying.remarks());
    keep_absent(after);
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
