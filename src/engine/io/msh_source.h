// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// A Gmsh file and a place in it: its sections, and the numbers in these, in text or in binary. What is wrong is told
/// by a ReadError that names the place: file and line of text, or section and byte of the file.
class MshSource {
public:
    /// Loads the file; throws ReadError that names it.
    explicit MshSource(const std::filesystem::path& path);

    /// The file as the caller named it.
    const std::string& shown() const { return shown_; }
    /// What there is to say of the file's text (plain_text.h).
    const std::vector<std::string>& remarks() const { return remarks_; }

    /// Numbers in sections are binary from now on; `swapped`: of the other byte order.
    void set_binary(bool swapped) {
        binary_ = true;
        swapped_ = swapped;
    }
    bool is_binary() const { return binary_; }
    /// Bytes of what size() reads in binary, 4 or 8.
    void set_size_bytes(int bytes) { size_bytes_ = bytes; }

    /// Back to the start of the file, as if nothing had been said of it.
    void rewind();
    /// Back to where the sections after the first begin.
    void rewind_to_sections();
    /// Goes behind the first line that is "$NAME", wherever it is; false, without moving, if there is none.
    bool find_section(std::string_view name);
    /// Goes behind the next line, which must be "$NAME"; the name, empty at the end of the file.
    std::string_view next_section();
    /// Goes behind the line "$EndNAME" of the current section, which must come next.
    void end_section();
    /// Goes behind the line "$EndNAME" of the current section, wherever it is.
    void skip_section();
    /// What skip_section() would pass over.
    std::string_view content() const;
    /// The number of the current section's first line.
    Index section_line() const;

    /// The next number: of four bytes in binary.
    Index integer() { return binary_ ? binary_value<std::int32_t>() : text_integer(); }
    /// The next number, of four or eight bytes in binary; it is not negative.
    Index size() {
        Index value = 0;
        if (!binary_)
            value = text_integer();
        else if (size_bytes_ == 8)
            value = binary_value<std::int64_t>();
        else
            value = binary_value<std::int32_t>();
        if (value < 0) fail("the number " + std::to_string(value) + " is negative");
        return value;
    }
    /// The next finite number: of eight bytes in binary.
    double real() {
        const double value = binary_ ? binary_value<double>() : text_real();
        if (!std::isfinite(value)) fail("a coordinate is not a finite number");
        return value;
    }
    /// Passes over a number as real() reads it, finite or not.
    void skip_real() {
        if (binary_)
            binary_value<double>();
        else if (const std::string_view found = word(); found.empty() || found[0] == '$')
            not_a_number("number");
    }
    /// Throws unless `count` things of `numbers` numbers each can still follow. Guards against counts that are damaged,
    /// before memory is taken for them.
    void expect(Index count, Index numbers) const;

    /// A whole number in text, also in binary files, which count so in some sections.
    Index text_integer() {
        const char* p = token();
        const auto [q, error] = std::from_chars(p + (p < end_ && *p == '+' ? 1 : 0), end_, integer_);
        if (error != std::errc() || (q < end_ && !is_blank(*q))) not_a_number("whole number");
        at_ = q;
        return integer_;
    }
    /// The rest of the line, without its end; goes behind it.
    std::string_view rest_of_line();
    /// The next word of text; empty at the end of the file.
    std::string_view word();

    /// Throws ReadError: the file, the place of what was read last, and `what`.
    [[noreturn]] void fail(const std::string& what) const;
    /// The place of what was read last: "a.msh:12: " or "a.msh: $Nodes, byte 1234: ".
    std::string where() const;

private:
    static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    const char* token() {
        while (at_ < end_ && is_blank(*at_)) ++at_;
        return last_ = at_;
    }
    template <class T>
    T binary_value() {
        last_ = at_;
        if (end_ - at_ < static_cast<std::ptrdiff_t>(sizeof(T))) fail("the file ends within the section");
        char bytes[sizeof(T)];
        std::memcpy(bytes, at_, sizeof(T));
        at_ += sizeof(T);
        if (swapped_)
            for (std::size_t k = 0; k < sizeof(T) / 2; ++k) std::swap(bytes[k], bytes[sizeof(T) - 1 - k]);
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }
    double text_real();
    [[noreturn]] void not_a_number(const char* wanted) const;

    std::string shown_;
    std::vector<std::string> remarks_;
    std::string text_;
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    const char* sections_ = nullptr;  // behind the first section
    const char* last_ = nullptr;      // start of what was read last
    const char* section_ = nullptr;   // behind the line that opens the current section
    std::string_view name_;           // of the current section
    Index integer_ = 0;
    bool binary_ = false;
    bool swapped_ = false;
    int size_bytes_ = 8;
};

}  // namespace femscalpel
