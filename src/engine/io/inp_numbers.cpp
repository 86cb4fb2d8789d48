// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/inp_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace femscalpel {
namespace {

constexpr std::size_t coordinate_width = 20;  // CalculiX reads (f20.0)

}  // namespace

void append_coordinate(std::string& out, double value) {
    char text[32];
    const char* end = std::to_chars(text, text + sizeof text, value).ptr;
    if (end - text <= static_cast<std::ptrdiff_t>(coordinate_width)) {
        out.append(text, static_cast<std::size_t>(end - text));
        return;
    }
    for (int digits_wanted = 17;; --digits_wanted) {
        end =
            digits_wanted == 17
                ? std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr
                : std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits_wanted - 1).ptr;
        const char* mantissa_end = std::find(text, const_cast<char*>(end), 'e');
        std::string digits, sign;
        for (const char* p = text; p < mantissa_end; ++p) {
            if (*p == '-')
                sign = '-';
            else if (*p != '.')
                digits += *p;
        }
        while (digits.size() > 1 && digits.back() == '0') digits.pop_back();
        const int exponent = std::atoi(std::string(mantissa_end + 1, end).c_str());
        // 12345e-9 and .0012345 are shorter than 1.2345e-05.
        const std::string forms[] = {
            sign + digits.substr(0, 1) + "." + digits.substr(1) + "e" + std::to_string(exponent),
            exponent < 0 ? sign + "." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits
                         : std::string(),
            sign + digits + "e" + std::to_string(exponent - static_cast<int>(digits.size()) + 1),
        };
        for (std::string form : forms)
            if (!form.empty() && form.size() <= coordinate_width) {
                // Rounded up, the largest numbers are infinite; the last digit that is not 0 stands before the
                // exponent.
                double back = 0;
                if (std::abs(value) > 1 &&
                    std::from_chars(form.data(), form.data() + form.size(), back).ec != std::errc())
                    --form[form.find('e') - 1];
                out += form;
                return;
            }
    }
}

void append_integer(std::string& out, Index value) {
    char text[24];
    out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

}  // namespace femscalpel
