// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mesh/mesh.h"

namespace femscalpel {

/// CalculiX counts in 32 bits.
inline constexpr Index largest_deck_number = 2147483647;

/// Appends `value` as a CalculiX deck holds it: in at most 20 characters, exactly if that is possible, otherwise the
/// closest that fits.
void append_coordinate(std::string& out, double value);

/// Appends `value` in digits.
void append_integer(std::string& out, Index value);

}  // namespace femscalpel
