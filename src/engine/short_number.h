// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace femscalpel {

/// A number in four digits for a message, as in "0.3333", "1.5e-05".
inline std::string short_number(double value) {
    std::array<char, 32> out{};
    (void)std::snprintf(out.data(), out.size(), "%.4g", value);
    return out.data();
}

}  // namespace femscalpel
