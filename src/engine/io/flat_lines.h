// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// The fields of a data line, and what shall stand in their place.
struct LineFields {
    std::vector<std::string_view> fields;          ///< between commas, with their blanks
    std::vector<std::optional<std::string>> with;  ///< per field; more than there are fields: further ones

    /// Whether the line has field `k` and it is not empty.
    bool has(std::size_t k) const;
    void put(std::size_t k, std::string text);
    /// Leaves out all fields from `count` on.
    void cut(std::size_t count);
};

/// Says where a line stands ("deck.inp:12: ").
using Where = std::function<std::string()>;
/// Changes a line of data, of that number among the card's data lines, from 0.
using ChangeLine = std::function<void(LineFields& line, std::size_t number, const Where& where)>;

/// Makes another card of one, line for line, so that messages name the lines of the user's file: each line of data by
/// `change`. Comments stay. The text of lines that do not change does not.
void change_lines(Card& card, const ChangeLine& change);

/// Puts other parameters on the keyword line of a card: those without a value there are left out of the ones they have.
/// The keyword line is one line then, as CalculiX reads it; lines that it loses become comments.
void change_parameters(Card& card, std::vector<CardParameter> parameters);

/// The comments of a card behind its keyword line, without its data.
std::vector<DeckText> comments_of(const Card& card);

}  // namespace femscalpel
