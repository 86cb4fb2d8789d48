// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// Splits a deck into its cards, with included files in place. The first has no keyword if there is text before the
/// deck's first card. Throws ReadError "file:line: ..." when a file is missing, damaged or includes itself. What
/// there is to say of the files' text is added to `remarks` (plain_text.h).
std::vector<Card> read_cards(const std::filesystem::path& deck, std::vector<std::string>& remarks);

}  // namespace femscalpel
