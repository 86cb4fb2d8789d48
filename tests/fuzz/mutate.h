// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "random_numbers.h"

namespace femscalpel::checks {

/// Damages a file as disks, editors and other programs do, and as somebody who looks for a reader's faults would:
/// bytes, words, lines and numbers are changed, left out, doubled or exchanged, its end is cut off, or a piece of
/// another file comes into it. One to four of these.
std::string mutated(std::string file, const std::string& other, Random& random);

}  // namespace femscalpel::checks
