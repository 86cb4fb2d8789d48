// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/vtu_bytes.h"

#include <algorithm>
#include <cstring>

#include "cancel.h"

namespace femscalpel {
namespace {

/// The six bits of a character of base64, 64 for the "=" at its end, -1 for others.
int base64_bits(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    if (c == '/') return 63;
    return c == '=' ? 64 : -1;
}

}  // namespace

bool VtuBytes::next_four() {
    unsigned bits = 0;
    std::size_t padding = 0;
    for (int k = 0; k < 4; ++k) {
        while (!text_.empty() && (text_[0] == ' ' || (text_[0] >= '\t' && text_[0] <= '\r'))) text_.remove_prefix(1);
        if (text_.empty()) return false;
        const int six = base64_bits(text_[0]);
        if (six < 0 || (six < 64 && padding > 0) || (six == 64 && k < 2)) return false;
        padding += six == 64;
        bits = bits << 6 | (six == 64 ? 0U : static_cast<unsigned>(six));
        text_.remove_prefix(1);
    }
    for (int k = 0; k < 3; ++k) decoded_[k] = static_cast<char>(bits >> (16 - 8 * k) & 0xFF);
    size_ = kept_ = 3 - padding;
    return true;
}

bool VtuBytes::read(char* out, std::size_t count) {
    if (!base64_) {
        if (count > text_.size()) return false;
        std::memcpy(out, text_.data(), count);
        text_.remove_prefix(count);
        return true;
    }
    SparseCheck check(1 << 16);
    while (count > 0) {
        check();
        if (kept_ == 0 && !next_four()) return false;
        const std::size_t now = std::min(count, kept_);
        std::memcpy(out, decoded_ + (size_ - kept_), now);
        out += now;
        count -= now;
        kept_ -= now;
    }
    return true;
}

}  // namespace femscalpel
