// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/card_numbers.h"

#include <array>
#include <charconv>

namespace femscalpel {

std::string number_text(double value) {
    std::array<char, 40> text{};
    char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    if (end - text.data() > 20)
        end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 12).ptr;
    std::string out(text.data(), end);
    if (out.find_first_of(".en") == out.npos) out += '.';
    return out;
}

}  // namespace femscalpel
