// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>

#include "mesh/mesh.h"

namespace femscalpel {

/// Puts those of the elements `parts` that are of another type than the *ELEMENT card they stand under says, because
/// they are parts of one that was, under a card of their own behind it: with the same parameters, and the type that
/// goes with that one (deck_label_for()). Sections, orientations and loads follow with the element sets. Nothing
/// without a deck.
void fit_cards(Mesh& mesh, std::span<const CellRef> parts);

}  // namespace femscalpel
