// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "mesh/cell_type.h"

namespace femscalpel {

/// An element card of Nastran that we have a type for.
struct BdfElement {
    std::string_view name;
    CellType type;       ///< with corners alone, or the only one
    CellType quadratic;  ///< with all mid-side nodes; the same if it has none
    bool has_property;   ///< field 3 is the number of a property
};

/// Null for other cards.
const BdfElement* bdf_element(std::string_view name);

/// The card that a type is written as; empty where Nastran has none.
std::string_view bdf_card(CellType type);

/// Node k of the card is our node order[k].
std::array<std::int8_t, 27> bdf_order(CellType type);

/// Whether it is a card of elements with material that we have no type for.
bool is_foreign_bdf_element(std::string_view name);

/// What a card holds that is not read: "a spring"; empty where its name is all there is to say.
std::string_view bdf_description(std::string_view name);

}  // namespace femscalpel
