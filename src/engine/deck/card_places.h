// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// Lines of a card that follow each other in one file.
struct CardLines {
    Index first = 1;  ///< number of the first in its file
    Index count = 0;
    std::string file;      ///< for messages; from the folder of the deck, if it is there
    bool carried = false;  ///< DeckFile::carried
};

/// Where the lines of each card of a deck come from: of one that was put together of parts and included files, this is
/// not where they are in a file that write_inp() makes.
std::vector<std::vector<CardLines>> card_places(const SolverInput& deck);

/// Makes messages about a deck that was read from what write_inp() made name the places that the cards had in the deck
/// that was written. Cards that do not have as many lines are left as they are; so are all where there is another
/// number of cards.
void set_card_places(SolverInput& deck, const std::vector<std::vector<CardLines>>& places);

}  // namespace femscalpel
