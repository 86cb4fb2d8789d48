// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/reference_nodes.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"
#include "deck/rules/marking.h"

namespace femscalpel {
namespace {

/// Of an entity: digits that fit an Index.
bool is_number(const std::string& text) {
    return !text.empty() && text.size() <= 18 && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Name and value of the parameters of a card that are reference nodes.
std::vector<std::pair<std::string, Index>> nodes_of(const Card& card) {
    std::vector<std::pair<std::string, Index>> out;
    const auto look = [&](std::string_view parameter, std::string_view written) {
        const std::string* value = card.parameter(parameter);
        if (value && is_number(*value)) out.emplace_back(written, std::stoll(*value));
    };
    if (card.keyword == "PRE-TENSIONSECTION") {
        look("NODE", "NODE");
    } else {
        look("REFNODE", "REF NODE");
        look("ROTNODE", "ROT NODE");
    }
    return out;
}

/// The beam that a pre-tension is in.
std::optional<Index> element_of(const Card& card) {
    const std::string* element = card.keyword == "PRE-TENSIONSECTION" ? card.parameter("ELEMENT") : nullptr;
    if (!element || !is_number(*element)) return {};
    return std::stoll(*element);
}

}  // namespace

bool ReferenceNodes::takes(const Card& card) const {
    return card.keyword == "RIGIDBODY" || card.keyword == "COUPLING" || card.keyword == "PRE-TENSIONSECTION";
}

bool ReferenceNodes::can_change(const Card& card) const { return !nodes_of(card).empty(); }

void ReferenceNodes::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    const CardReader head(card);
    for (const auto& [parameter, node] : nodes_of(card)) numbers.name_node(head, node);
    if (const auto element = element_of(card)) numbers.name_element(head, *element);
}

void ReferenceNodes::mark(std::size_t /*c*/, const Card& card, Marking& marking) {
    for (const auto& [parameter, node] : nodes_of(card)) marking.pin(node);
}

void ReferenceNodes::carry(std::size_t c, const Card& card, Carrying& carrying) {
    for (const auto& [parameter, node] : nodes_of(card)) {
        const auto tell = [&](const std::string& what) {
            carrying.remarks().add(c, Weight::problem, card.where() + ": ", the_node(node), what);
        };
        if (carrying.node_gone(node))
            tell("was removed; give another " + parameter);
        else if (carrying.origins().is_doubled(node))
            tell("the crack doubled; " + parameter + " stays the original, on the negative side");
    }
    const std::optional<Index> element = element_of(card);
    if (!element || !carrying.had_element(*element)) return;
    const Index number = *element;
    const std::vector<Index> parts = carrying.parts_of(number);
    if (parts != std::vector<Index>{number})
        carrying.remarks().add(c, Weight::problem, card.where() + ": ", the_element(number),
                               parts.empty() ? "was removed; give another ELEMENT"
                                             : "was divided; the pre-tension stays with its first part");
}

}  // namespace femscalpel
