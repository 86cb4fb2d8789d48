// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/mesh_cards.h"

#include <algorithm>

#include "deck/rules/carrying.h"
#include "deck/rules/marking.h"

namespace femscalpel {

bool is_mesh_card(const Card& card) {
    constexpr std::string_view keywords[] = {"NODE", "ELEMENT", "NSET", "ELSET", "SURFACE"};
    return std::ranges::find(keywords, card.keyword) != std::end(keywords);
}

void MeshCards::end_marking(Marking& marking) {
    for (const OtherElement& e : marking.deck().input().other_elements())
        for (const Index node : e.nodes) marking.pin(node);
}

void MeshCards::end_carrying(Carrying& carrying) {
    const SolverInput& deck = carrying.old().input();
    for (const OtherElement& e : deck.other_elements()) {
        const std::string where = deck.cards()[e.card].where() + ": ",
                          element = "element " + std::to_string(e.number) + " of type " + e.type;
        for (const Index node : e.nodes)
            if (carrying.node_gone(node))
                throw Error(where + element + " needs " + the_node(node).text() +
                            ", which would be removed, and cannot be removed itself. Move the tool, or take the "
                            "element out of the deck");
            else if (carrying.origins().is_doubled(node))
                carrying.remarks().add(
                    e.card, Weight::problem, where, the_node(node),
                    "the crack doubled; " + element + " stays with the original, on the negative side");
    }
}

}  // namespace femscalpel
