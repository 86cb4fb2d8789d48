// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// A card of a Nastran deck's bulk data.
struct BdfCard {
    std::string name;                      ///< in capitals, without the asterisk of large fields
    std::vector<std::string_view> fields;  ///< those behind the name, without blanks around; the last is not empty
    const char* at = nullptr;              ///< where it begins

    /// Empty behind the last.
    std::string_view field(std::size_t k) const { return k < fields.size() ? fields[k] : std::string_view(); }
};

/// A statement of case control, in capitals, with the lines it goes on in.
struct BdfStatement {
    std::string text;
    const char* at;
};

/// A Nastran deck and a place in it. What is wrong is told by a ReadError that names file and line.
class BdfSource {
public:
    /// Loads the file and finds its parts. Throws ReadError.
    explicit BdfSource(const std::filesystem::path& path);

    const std::string& shown() const { return shown_; }
    /// What there is to say of the file's text (plain_text.h).
    const std::vector<std::string>& remarks() const { return remarks_; }
    /// Lines that begin with $.
    const std::vector<std::string_view>& comments() const { return comments_; }
    /// Executive and case control.
    const std::vector<BdfStatement>& statements() const { return statements_; }

    /// The next card of bulk data; false behind the last.
    bool next(BdfCard& card);

    /// A field as a whole number. `what` it is, for messages.
    Index integer(const BdfCard& card, std::size_t field, const char* what) const;
    /// The same, or `otherwise` if it is empty.
    Index integer(const BdfCard& card, std::size_t field, const char* what, Index otherwise) const;
    /// A field as a finite number, also as 1.5-3 and 1.5D-3; 0 if it is empty.
    double real(const BdfCard& card, std::size_t field, const char* what) const;

    /// "a.bdf:12: "
    std::string where(const char* at) const;
    [[noreturn]] void fail(const char* at, const std::string& what) const;

private:
    std::string_view line_at(const char* at) const;
    void expand_tabs();
    void find_parts();
    void add_line(std::string_view line, BdfCard& card) const;
    void add_free(std::string_view line, bool first, BdfCard& card) const;
    void add_columns(std::string_view line, bool first, BdfCard& card) const;

    std::string shown_;
    std::vector<std::string> remarks_;
    std::string text_;
    std::vector<std::string_view> comments_;
    std::vector<BdfStatement> statements_;
    const char* at_ = nullptr;  // of the next line of bulk data
    const char* end_ = nullptr;
    mutable std::string mark_;  // of the line that is to go on, if it has one
};

/// A number as Nastran writes it: 1.5-3, 1.5D-3, 1.5E-3, 1.5.
std::optional<double> bdf_real(std::string_view text);

}  // namespace femscalpel
