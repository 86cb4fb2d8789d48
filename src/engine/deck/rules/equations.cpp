// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/equations.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"
#include "deck/rules/marking.h"

namespace femscalpel {
namespace {

/// Cards that take degrees of freedom out of equations.
bool removes(const Card& card) { return card.parameter("REMOVE"); }

/// Reads degree of freedom and factor of a term.
bool read_factor(NodeEquation::Term& term) {
    Card card;
    card.set_text("*EQUATION\n" + term.written + "\n");
    CardReader line(card);
    return line.next_data_line() && line.integer(term.dof) && line.number(term.factor);
}

void check_node(std::size_t c, const CardReader& line, Index node, bool copies_follow, Carrying& carrying) {
    const auto tell = [&](const char* what) {
        carrying.remarks().add(c, Weight::problem, line.where(), the_node(node), what);
    };
    if (carrying.node_gone(node))
        tell("was removed; its equation is left out");
    else if (carrying.origins().is_doubled(node) && !copies_follow)
        tell("the crack doubled; the equation stays with the original, on the negative side");
}

}  // namespace

bool Equations::takes(const Card& card) const { return card.keyword == "EQUATION" || card.keyword == "NETWORKMPC"; }

Equations::Read Equations::read(const Card& card) {
    Read out;
    CardReader line(card);
    while (line.next_data_line()) {
        Equation equation{{line}, {}, false, {}};
        Index terms = 0;
        if (!line.integer(terms) || terms < 1 || !line.next_data_line()) {
            out.unreadable = line;
            break;
        }
        out.equations.push_back(read_terms(line, std::move(equation), terms));
        if (!out.equations.back().complete) break;
    }
    return out;
}

Equations::Equation Equations::read_terms(CardReader& line, Equation equation, Index terms) {
    equation.lines.push_back(line);
    for (Index k = 0; k < 3 * terms;) {
        if (line.at_end()) {
            if (!line.next_data_line()) return equation;
            equation.lines.push_back(line);
            continue;
        }
        Entry entry{equation.lines.size() - 1, {}, {}};
        if (k++ % 3 == 0) {
            entry.what = read_number_or_set(line);
            if (entry.what) entry.text = entry.what->is_number() ? std::to_string(entry.what->number) : entry.what->set;
        } else {
            entry.text = line.field();
        }
        equation.entries.push_back(std::move(entry));
    }
    equation.complete = true;
    return equation;
}

/// The equation as one of nodes by number; none if it is not.
std::optional<NodeEquation> Equations::of_nodes(const Equation& equation) {
    if (!equation.complete) return {};
    NodeEquation out;
    for (std::size_t k = 0; k < equation.entries.size(); k += 3) {
        const std::optional<NumberOrSet>& node = equation.entries[k].what;
        if (!node || !node->is_number()) return {};
        NodeEquation::Term term{node->number, 0, 0, equation.entries[k + 1].text + ", " + equation.entries[k + 2].text};
        if (!read_factor(term)) return {};
        out.terms.push_back(std::move(term));
    }
    return out;
}

void Equations::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    if (removes(card)) return numbers.name_nodes_first(card);
    CardReader line(card);
    Index terms = 0;
    while (line.next_data_line() && line.integer(terms) && line.next_data_line())
        for (Index k = 0; k < 3 * terms;) {
            if (line.at_end()) {
                if (!line.next_data_line()) return;
                continue;
            }
            Index node = 0;
            if (k++ % 3 != 0 || !line.integer(node))
                line.field();
            else
                numbers.name_node(line, node);
        }
}

void Equations::mark(std::size_t /*c*/, const Card& card, Marking& marking) {
    if (removes(card)) return;
    const DeckView& deck = marking.deck();
    for (const Equation& equation : read(card).equations) {
        if (const auto nodes = of_nodes(equation);
            nodes && nodes->terms.size() == 2 && marking.is_one_place(nodes->terms[0].node, nodes->terms[1].node)) {
            marking.pin_pair(nodes->terms[0].node, nodes->terms[1].node);
            continue;
        }
        for (const Entry& entry : equation.entries) {
            if (!entry.what) continue;
            if (entry.what->is_number())
                marking.pin_related(entry.what->number);
            else if (const auto group = deck.group(DeckSetType::nset, entry.what->set))
                for (const Index node : deck.members(*group)) marking.pin(node);
        }
    }
}

void Equations::begin_carrying(Carrying& carrying) {
    const std::vector<Card>& cards = carrying.old().cards();
    std::vector<NodeEquation> all;
    for (std::size_t c = 0; c < cards.size(); ++c) {
        if (cards[c].keyword != "EQUATION" || removes(cards[c])) continue;
        Read& there = read_.emplace(c, read(cards[c])).first->second;
        for (Equation& equation : there.equations) {
            auto nodes = of_nodes(equation);
            if (!nodes) continue;
            equation.related = all.size();
            places_.emplace_back(c, equation.lines.back());
            all.push_back(std::move(*nodes));
        }
    }
    relate(all, carrying);
}

/// Adds the equations of new nodes.
void Equations::relate(const std::vector<NodeEquation>& equations, Carrying& carrying) {
    related_ = relate_new_nodes(equations, carrying.before(), carrying.old().numbers(), carrying.origins(),
                                carrying.changes());
    std::set<std::pair<Index, Index>> dependent;  // node and degree of freedom
    for (const NodeEquation& e : equations) dependent.emplace(e.terms.front().node, e.terms.front().dof);
    for (const RelatedNodes::Made& made : related_.made) {
        if (!std::ranges::all_of(made.nodes, [&](Index n) { return carrying.new_numbers().node(n).has_value(); }))
            continue;
        const NodeEquation& like = equations[made.like];
        // The solver eliminates the first term, which no other equation may do.
        std::vector<std::size_t> order(made.nodes.size());
        std::iota(order.begin(), order.end(), 0);
        const auto eliminated = [&](std::size_t k) { return std::pair(made.nodes[k], like.terms[k].dof); };
        const auto first =
            std::ranges::find_if(order, [&](std::size_t k) { return !dependent.contains(eliminated(k)); });
        if (first == order.end()) {
            related_.missed.push_back({made.like, made.nodes.front()});
            continue;
        }
        std::rotate(order.begin(), first, first + 1);
        dependent.insert(eliminated(order.front()));
        std::string text = std::to_string(made.nodes.size());
        for (std::size_t k = 0; k < order.size(); ++k)  // CalculiX reads four terms per line
            text +=
                (k % 4 == 0 ? "\n" : ", ") + std::to_string(made.nodes[order[k]]) + ", " + like.terms[order[k]].written;
        const auto& [c, last] = places_[made.like];
        carrying.edits(c).add_after(last, text);
    }
    tell_unrelated(related_.missed,
                   "lie between nodes that this card relates, but have no counterpart between the partners of "
                   "these, or the equations of these are "
                   "of different form: they are not related. Give them equations, or move the tool so that both "
                   "sides are divided alike",
                   carrying);
    tell_unrelated(related_.one_sided,
                   "on the crack lie between nodes that this card relates, and their partners are not doubled: "
                   "only those on the negative side are "
                   "related. Check the equations there",
                   carrying);
}

/// One message per card.
void Equations::tell_unrelated(const std::vector<RelatedNodes::Missed>& missed, const std::string& what,
                               Carrying& carrying) {
    std::map<std::size_t, std::pair<CardReader, std::set<Index>>> by_card;
    for (const RelatedNodes::Missed& m : missed)
        by_card.try_emplace(places_[m.like].first, places_[m.like].second, std::set<Index>{})
            .first->second.second.insert(m.node);
    for (const auto& [c, found] : by_card)
        carrying.remarks().add_new_nodes(found.first.where() + "*" + carrying.old().cards()[c].keyword + ": ",
                                         found.second, what);
}

void Equations::carry(std::size_t c, const Card& card, Carrying& carrying) {
    if (removes(card)) {
        CardReader line(card);
        while (const auto what = next_entry(line))
            if (what->is_number()) check_node(c, line, what->number, false, carrying);
        return;
    }
    const auto known = read_.find(c);
    Read there = known == read_.end() ? read(card) : std::move(known->second);
    for (Equation& equation : there.equations) carry_equation(c, std::move(equation), carrying);
    if (there.unreadable)
        carrying.remarks().add_problem(there.unreadable->where() + "*" + card.keyword +
                                       ": no equation can be read here; the rest of the card is kept as it is");
}

void Equations::carry_equation(std::size_t c, Equation equation, Carrying& carrying) {
    const bool copies_follow = equation.related && related_.copies_follow[*equation.related];
    std::set<std::size_t> changed;
    bool gone = false;
    for (Entry& entry : equation.entries) {
        if (!entry.what) continue;
        const CardReader& line = equation.lines[entry.line];
        if (entry.what->is_number()) {
            gone = gone || carrying.node_gone(entry.what->number);
            check_node(c, line, entry.what->number, copies_follow, carrying);
        } else {
            carry_set(c, line, entry, carrying);
            if (entry.text != entry.what->set) changed.insert(entry.line);
        }
    }
    if (!equation.complete) return;
    CardEdits& edits = carrying.edits(c);
    if (gone)
        for (const CardReader& line : equation.lines) edits.drop(line);
    else
        for (const std::size_t k : changed) edits.replace(equation.lines[k], line_text(equation, k));
}

void Equations::carry_set(std::size_t c, const CardReader& line, Entry& entry, Carrying& carrying) {
    Remarks& remarks = carrying.remarks();
    const std::string& set = entry.what->set;
    entry.text = carrying.closed_sets().name_of_old_members(set);
    if (carrying.closed_sets().lost_members(set) > 0)
        remarks.add(c, Weight::problem, line.where(), the_set(set), "lost nodes; its pairs no longer match");
    if (entry.text == set) return;
    remarks.add_replaced(set, entry.text);
    remarks.add(c, Weight::problem, line.where(), the_set(set),
                "has new nodes; the equations stay with the nodes it had ('" + entry.text + "')");
}

std::string Equations::line_text(const Equation& equation, std::size_t line) {
    std::string out;
    for (const Entry& entry : equation.entries)
        if (entry.line == line) out += (out.empty() ? "" : ", ") + entry.text;
    return out;
}

}  // namespace femscalpel
