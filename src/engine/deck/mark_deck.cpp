// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/mark_deck.h"

#include <algorithm>

#include "deck/bound_nodes.h"
#include "deck/rules/marking.h"
#include "deck/rules/rules.h"

namespace femscalpel {

DeckMarks mark_deck(const Mesh& mesh) {
    if (!solver_input(mesh)) return {};
    Marking marking(mesh);
    const CardRules rules;
    const std::vector<Card>& cards = marking.deck().cards();
    for (std::size_t c = 0; c < cards.size(); ++c)
        if (CardRule* rule = rules.find(cards[c])) rule->mark(c, cards[c], marking);
    for (const auto& rule : rules.all()) rule->end_marking(marking);
    DeckMarks marks = marking.result();
    const BoundNodes bound(mesh);
    for (Index n = 0; n < mesh.node_count() && !bound.empty(); ++n) {
        if (bound.is_bound(mesh.node_ids[n])) marks.no_tips.push_back(n);
        if (bound.is_related(mesh.node_ids[n])) marks.no_bases.push_back(n);
    }
    return marks;
}

void remove_marks(Mesh& mesh) {
    std::vector<bool> marks(mesh.groups.size());
    for (std::size_t g = 0; g < marks.size(); ++g)
        marks[g] = mesh.groups[g].hidden && mesh.groups[g].name.starts_with(mark_prefix);
    if (std::ranges::find(marks, true) != marks.end()) remove_groups(mesh, marks);
}

}  // namespace femscalpel
