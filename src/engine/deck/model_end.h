// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// Adds cards to the end of a deck's model definition: before its first step, but after its last set.
void add_to_model(SolverInput& deck, std::vector<Card> cards);

}  // namespace femscalpel
