// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "deck/solver_input.h"
#include "io/instance_placement.h"

namespace femscalpel {

/// An *INSTANCE of a deck of parts.
struct PartInstance {
    std::string name, part;
    const Card* card = nullptr;
    Placement placement;
    bool first = true;               ///< of its part
    std::vector<const Card*> cards;  ///< the part's, then those that stand in the instance itself
};

/// One step through a deck of parts: a card of the assembly, the model or a step, or an instance in its place. Cards
/// that only say where something starts and ends have a part in it for their comments.
struct DeckItem {
    const Card* card = nullptr;
    bool is_bracket = false;                              ///< *ASSEMBLY, *END PART, ...
    std::size_t instance = static_cast<std::size_t>(-1);  ///< into PartDeck::instances, if `card` is null
};

/// A deck of parts and an assembly, taken apart.
struct PartDeck {
    std::vector<PartInstance> instances;
    std::vector<DeckItem> items;
    std::string assembly;               ///< its name
    std::vector<std::string> warnings;  ///< parts without an instance
};

/// The name on a card, without quotes; blanks inside stay.
std::string unquoted(std::string_view name);

/// How names of parts, instances and sets compare: deck_key() without quotes.
std::string name_key(std::string_view name);

/// Takes the cards of a deck apart, which must outlive the result. Throws ReadError "file:line: ..." for parts,
/// instances and assemblies that do not end, stand in each other, have no name or one that is used before, for
/// instances of a part that is not there, and for those imported from an earlier analysis.
PartDeck take_parts_apart(const std::vector<Card>& cards);

}  // namespace femscalpel
