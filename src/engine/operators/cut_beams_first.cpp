// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/cut_beams_first.h"

#include <algorithm>
#include <iterator>

#include "cutting/split_beams.h"
#include "deck/mark_deck.h"
#include "operators/simplify_first.h"

namespace femscalpel {

std::optional<BeamsCut> cut_beams_first(const Mesh& mesh, std::span<const Blade> blades, const Prepared& known) {
    const BeamCuts cuts = find_beam_cuts(mesh, blades);
    if (cuts.empty()) return {};
    BeamsCut out;
    for (const Index n : cuts.stops) out.stops.push_back(mesh.node_ids[n]);
    if (cuts.cuts.empty()) return out;
    DeckMarks own;
    if (!known.marks) own = mark_deck(mesh);
    const DeckMarks& marks = known.marks ? *known.marks : own;
    Simplified parts = split_beams(marks.mesh ? *marks.mesh : mesh, cuts, next_numbers(mesh));
    std::ranges::copy(parts.stops, std::back_inserter(out.stops));
    out.divided = with_parts(mesh, std::move(parts), marks, known);
    return out;
}

}  // namespace femscalpel
