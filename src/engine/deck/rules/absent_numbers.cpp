// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/absent_numbers.h"

#include <algorithm>
#include <set>

#include "cancel.h"
#include "deck/rules/rules.h"

namespace femscalpel {
namespace {

/// What a node or an element of CalculiX can have as its number.
constexpr Index largest_possible = 2147483647;

}  // namespace

AbsentNumbers::AbsentNumbers(const Mesh& mesh, const SolverInput& input) : input_(input), numbers_(mesh) {
    for (const OtherElement& e : input.other_elements()) others_.push_back(e.number);
    std::ranges::sort(others_);
    const CardRules rules;
    for (card_ = 0; card_ < cards().size(); ++card_) {
        check_cancelled();
        if (const CardRule* rule = rules.find(cards()[card_])) rule->list_numbers(cards()[card_], *this);
    }
}

void AbsentNumbers::name_nodes_first(const Card& card) {
    CardReader line(card);
    Index number = 0;
    while (line.next_data_line())
        if (line.integer(number)) name_node(line, number);
}

void AbsentNumbers::name_elements_first(const Card& card) {
    CardReader line(card);
    Index number = 0;
    while (line.next_data_line())
        if (line.integer(number)) name_element(line, number);
}

void AbsentNumbers::name(bool node, const CardReader& line, Index number) {
    if (number <= 0 || number > largest_possible) return;
    if (node ? numbers_.node(number).has_value()
             : numbers_.cell(number).has_value() || std::ranges::binary_search(others_, number))
        return;
    const auto is_it = [&](const OfCard& known) { return known.card == card_ && known.node == node; };
    const auto recent = all_.end() - std::min<std::ptrdiff_t>(2, std::ssize(all_));
    auto known = std::find_if(recent, all_.end(), is_it);
    if (known == all_.end()) known = all_.insert(known, {card_, node, line.where(), {}});
    known->numbers.push_back(number);
}

Index AbsentNumbers::largest(bool node) const {
    Index out = 0;
    for (const OfCard& named : all_)
        if (named.node == node) out = std::max(out, std::ranges::max(named.numbers));
    return out;
}

std::string named_text(const AbsentNumbers::OfCard& named, const Card& card) {
    const std::size_t count = std::set<Index>(named.numbers.begin(), named.numbers.end()).size();
    return "*" + card.keyword + " names " + (named.node ? "node " : "element ") +
           std::to_string(named.numbers.front()) + (count > 1 ? " and " + std::to_string(count - 1) + " more" : "");
}

void warn_of_absent_numbers(const Mesh& mesh, SolverInput& input) {
    const AbsentNumbers absent(mesh, input);
    for (const AbsentNumbers::OfCard& named : absent.all())
        input.warnings().push_back(named.where + named_text(named, input.cards()[named.card]) +
                                   " that the deck does not define; kept as it is, correct the line");
    input.keep_numbers(absent.largest_node(), absent.largest_element());
}

}  // namespace femscalpel
