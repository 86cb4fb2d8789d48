// SPDX-License-Identifier: LGPL-2.1-or-later
#include "utf8.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "cancel.h"

namespace femscalpel {
namespace {

/// What Windows-1252 has at 0x80 to 0x9F.
constexpr std::array<std::uint16_t, 32> windows_1252 = {0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                                        0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0x008D, 0x017D, 0x008F,
                                                        0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                                        0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};

/// Length of the character that `text` begins with, which is not empty; 0 if there is none.
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    const std::size_t n = lead < 0x80                   ? 1
                          : lead >= 0xC2 && lead < 0xE0 ? 2
                          : lead >= 0xE0 && lead < 0xF0 ? 3
                          : lead >= 0xF0 && lead < 0xF5 ? 4
                                                        : 0;
    if (n == 0 || text.size() < n) return 0;
    for (std::size_t i = 1; i < n; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    if (lead == 0xE0 && byte(1) < 0xA0) return 0;
    if (lead == 0xED && byte(1) >= 0xA0) return 0;
    if (lead == 0xF0 && byte(1) < 0x90) return 0;
    if (lead == 0xF4 && byte(1) >= 0x90) return 0;
    return n;
}

}  // namespace

std::size_t not_utf8(std::string_view text) {
    constexpr std::uint64_t high_bits = 0x8080808080808080;
    SparseCheck check(1 << 20);
    for (std::size_t at = 0; at < text.size(); check()) {
        std::uint64_t eight = high_bits;
        if (at + sizeof eight <= text.size()) std::memcpy(&eight, text.data() + at, sizeof eight);
        if ((eight & high_bits) == 0) {
            at += sizeof eight;
            continue;
        }
        const std::size_t n = utf8_length(text.substr(at));
        if (n == 0) return at;
        at += n;
    }
    return std::string_view::npos;
}

std::string from_windows_1252(std::string_view bytes) {
    std::string out;
    out.reserve(bytes.size() + bytes.size() / 16);
    SparseCheck check(1 << 20);
    for (const char c : bytes) {
        check();
        unsigned code = static_cast<unsigned char>(c);
        if (code < 0x80) {
            out += c;
            continue;
        }
        if (code < 0xA0) code = windows_1252[code - 0x80];
        if (code < 0x800) {
            out += static_cast<char>(0xC0 | (code >> 6));
        } else {
            out += static_cast<char>(0xE0 | (code >> 12));
            out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
        }
        out += static_cast<char>(0x80 | (code & 0x3F));
    }
    return out;
}

std::optional<std::string> to_windows_1252(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t n = utf8_length(text);
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
        if (n == 0 || n > 3) return {};
        const unsigned code = n == 1   ? byte(0)
                              : n == 2 ? (byte(0) & 0x1Fu) << 6 | (byte(1) & 0x3Fu)
                                       : (byte(0) & 0x0Fu) << 12 | (byte(1) & 0x3Fu) << 6 | (byte(2) & 0x3Fu);
        const auto* const found = std::ranges::find(windows_1252, code);
        if (found != windows_1252.end())
            out += static_cast<char>(0x80 + (found - windows_1252.begin()));
        else if (code < 0x80 || (code >= 0xA0 && code < 0x100))
            out += static_cast<char>(code);
        else
            return {};
        text.remove_prefix(n);
    }
    return out;
}

std::string as_utf8(std::string name) {
    return not_utf8(name) == std::string::npos ? std::move(name) : from_windows_1252(name);
}

std::string shown_path(const std::filesystem::path& path) { return as_utf8(path.string()); }

}  // namespace femscalpel
