// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string_view>

namespace femscalpel {

/// Bytes one after the other from a text that holds them as they are or in base64. VTK ends base64 with "=" after the
/// head of an array, or goes on; both are read.
class VtuBytes {
public:
    VtuBytes(std::string_view text, bool base64) : text_(text), base64_(base64) {}

    /// Fills `out`; false if there are not so many bytes, or what is there is no base64.
    bool read(char* out, std::size_t count);
    /// At most so many bytes are left.
    std::size_t left() const { return base64_ ? text_.size() / 4 * 3 + kept_ : text_.size(); }

private:
    bool next_four();

    std::string_view text_;
    bool base64_;
    char decoded_[3] = {};  // the last `kept_` of these were not given yet
    std::size_t size_ = 0, kept_ = 0;
};

}  // namespace femscalpel
