// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/scalpel.h"

#include "deck/mark_deck.h"
#include "groups/group_report.h"
#include "mesh/adjacency.h"

namespace femscalpel {

struct Scalpel::State {
    std::shared_ptr<const Mesh> mesh;
    DeckMarks marks;
    Adjacency adjacency;
    FamilyTotals totals;
};

Scalpel::Scalpel(std::shared_ptr<const Mesh> mesh) {
    DeckMarks marks = mark_deck(*mesh);
    Adjacency adjacency(*mesh);
    FamilyTotals totals = family_totals(marks.mesh ? *marks.mesh : *mesh);
    state_ = std::make_unique<State>(State{std::move(mesh), std::move(marks), std::move(adjacency), std::move(totals)});
}

Scalpel::~Scalpel() = default;
Scalpel::Scalpel(Scalpel&&) noexcept = default;

const Mesh& Scalpel::mesh() const { return *state_->mesh; }

Prepared Scalpel::prepared() const { return {&state_->adjacency, &state_->totals, &state_->marks}; }

}  // namespace femscalpel
