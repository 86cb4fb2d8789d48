// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace femscalpel {

/// A number as a card has it: no longer than the 20 characters that CalculiX reads, and never like a whole number.
std::string number_text(double value);

}  // namespace femscalpel
