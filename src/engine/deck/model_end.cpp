// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/model_end.h"

#include <algorithm>
#include <iterator>

#include "deck/rules/mesh_cards.h"

namespace femscalpel {

void insert_cards(SolverInput& deck, std::size_t place, std::vector<Card> cards) {
    // Elements outside the mesh know their card by its place.
    for (OtherElement& e : deck.other_elements())
        if (e.card >= place) e.card += cards.size();
    deck.cards().insert(deck.cards().begin() + static_cast<std::ptrdiff_t>(place),
                        std::make_move_iterator(cards.begin()), std::make_move_iterator(cards.end()));
}

void add_to_model(SolverInput& deck, std::vector<Card> cards) {
    std::vector<Card>& all = deck.cards();
    auto at = std::ranges::find(all, "STEP", &Card::keyword);
    const auto last_of_mesh = std::find_if(all.rbegin(), all.rend(), is_mesh_card).base();
    if (at < last_of_mesh) at = last_of_mesh;
    insert_cards(deck, static_cast<std::size_t>(at - all.begin()), std::move(cards));
}

}  // namespace femscalpel
