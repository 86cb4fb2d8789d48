// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <charconv>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Whole numbers in universal files have ten columns, one behind the other.
inline constexpr std::ptrdiff_t unv_width = 10;

/// A data set of a universal file: what stands between two lines of -1.
struct UnvDataset {
    std::string_view number;   ///< "2411"; "58b" if it is binary
    std::string_view content;  ///< the lines after that of the number
};

/// A universal file and a place in it. What is wrong is told by a ReadError that names file and line.
class UnvSource {
public:
    /// Loads the file and finds its data sets. Throws ReadError.
    explicit UnvSource(const std::filesystem::path& path);

    const std::string& shown() const { return shown_; }
    /// What there is to say of the file's text (plain_text.h).
    const std::vector<std::string>& remarks() const { return remarks_; }
    const std::vector<UnvDataset>& datasets() const { return datasets_; }

    /// Goes to the start of a data set, which all that follows stays in.
    void open(const UnvDataset& dataset);
    /// Nothing but blanks follows in the data set.
    bool at_end() {
        skip_blanks();
        return at_ == end_;
    }
    /// The next word as a whole number; `what` it is, for messages. Numbers of ten digits fill their columns: several
    /// may stand in a word, which ends where a column ends, then.
    Index integer(const char* what) {
        skip_blanks();
        Index value = 0;
        const auto [q, error] = std::from_chars(at_, end_, value);
        if (q - at_ > unv_width) return integer_of_columns(what);
        if (error != std::errc() || (q < end_ && !is_blank(*q))) not_a_number(what, "whole number");
        at_ = q;
        return value;
    }
    /// The next word as a finite number, also with a D before the exponent.
    double real(const char* what);
    /// The rest of the line, without its end and blanks there; goes to the next line.
    std::string_view rest_of_line();
    /// How many words the line has that is `ahead` lines behind this one; 0 at the end.
    int words_ahead(int ahead) const;
    /// The words of the rest of this line.
    int words_left() const { return words_ahead(0); }

    /// The place of what was read last.
    const char* last() const { return last_; }
    /// "a.unv:12: "; `at` is a place of last(), or null for that of what was read last.
    std::string where(const char* at = nullptr) const;
    [[noreturn]] void fail(const std::string& what, const char* at = nullptr) const;
    /// Bytes that are left in the data set.
    Index left() const { return end_ - at_; }

private:
    static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
    void skip_blanks() {
        while (at_ < end_ && is_blank(*at_)) ++at_;
        last_ = at_;
    }
    /// Where the number ends that starts at `at` and that a column ends which is full, so that the next number follows
    /// without a blank; `stop`, the end of the word, if that is one number.
    const char* end_of_column(const char* at, const char* stop) const;
    /// See integer(): of a word that is longer than a column.
    Index integer_of_columns(const char* what);
    void find_datasets();
    [[noreturn]] void not_a_number(const char* what, const char* wanted) const;

    std::string shown_;
    std::vector<std::string> remarks_;
    std::string text_;
    std::vector<UnvDataset> datasets_;
    const UnvDataset* dataset_ = nullptr;
    const char* at_ = nullptr;
    const char* end_ = nullptr;
    const char* last_ = nullptr;
};

}  // namespace femscalpel
