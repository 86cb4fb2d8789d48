// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// Adds cards to a deck before the one at `place`.
void insert_cards(SolverInput& deck, std::size_t place, std::vector<Card> cards);

/// Adds cards to the end of a deck's model definition: before its first step, but after its last set.
void add_to_model(SolverInput& deck, std::vector<Card> cards);

}  // namespace femscalpel
