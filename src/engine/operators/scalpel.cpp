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

    Prepared prepared() const { return {&adjacency, &totals, &marks}; }
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

Result Scalpel::crack(const Tool& tool, const CrackOptions& options) const {
    return femscalpel::crack(*state_->mesh, tool, options, state_->prepared());
}

Result Scalpel::drill(std::span<const Tool* const> tools, const DrillOptions& options) const {
    return femscalpel::drill(*state_->mesh, tools, options, state_->prepared());
}

Result Scalpel::cut(const Tool& positive, const Tool& negative, const CutOptions& options) const {
    return femscalpel::cut(*state_->mesh, positive, negative, options, state_->prepared());
}

Result Scalpel::cut(const Plane& plane, double width, const CutOptions& options) const {
    return femscalpel::cut(*state_->mesh, plane, width, options, state_->prepared());
}

}  // namespace femscalpel
