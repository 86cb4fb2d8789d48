// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "deck/solver_input.h"

namespace femscalpel {

/// Said in the place of a line that was made from another: "deck.inp:12 (carried over): ".
inline constexpr std::string_view carried_over = " (carried over)";

/// Changes to the lines of a card; what is not changed keeps its text and its line number.
class CardEdits {
public:
    bool empty() const { return edits_.empty(); }

    /// Leaves out the line `reader` is on.
    void drop(const CardReader& reader) { edits_[reader.raw().data()].drop = true; }
    /// Adds a line after the one `reader` is on.
    void add_after(const CardReader& reader, std::string_view line) { add(reader.raw().data(), line); }
    /// Replaces the line `reader` is on.
    void replace(const CardReader& reader, std::string_view line) {
        drop(reader);
        add_after(reader, line);
    }
    /// Adds a line after the last data line of `card`, or after its keyword line.
    void append(const Card& card, std::string_view line);

    /// Carries the edits out. New lines say where they came from when asked for their place.
    void apply(Card& card) const;

private:
    struct Edit {
        bool drop = false;
        std::string added;
    };
    void add(const char* at, std::string_view line);

    std::map<const char*, Edit> edits_;  // by start of the line in its file's text
    const char* last_line_ = nullptr;    // of the card append() was called for
};

}  // namespace femscalpel
