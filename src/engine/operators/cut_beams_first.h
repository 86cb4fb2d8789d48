// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cutting/workpiece.h"
#include "operators/prepared.h"
#include "operators/refine_first.h"

namespace femscalpel {

/// Beams that an operation's blades pass through.
struct BeamsCut {
    std::optional<Refined> divided;  ///< the mesh with these beams divided there, if any had to be
    std::vector<Index> stops;        ///< Prepared::beam_stops
};

/// Divides beams where an operation's blades pass through them (split_beams()); nothing where none does. `known` is
/// what is known of `mesh`. Throws what carry_deck() does.
std::optional<BeamsCut> cut_beams_first(const Mesh& mesh, std::span<const Blade> blades, const Prepared& known);

}  // namespace femscalpel
