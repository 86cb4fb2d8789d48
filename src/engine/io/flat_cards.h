// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "io/flat_lines.h"
#include "io/flat_names.h"

namespace femscalpel {

/// Makes cards of the flat deck of those of parts, instances, the assembly, the model and the steps: numbers and names
/// become those of the flat deck, coordinates and directions of an instance those of the assembly.
class FlatCards {
public:
    /// `names` and `warnings` must outlive it. Warnings go to `warnings`.
    FlatCards(const FlatNames& names, std::vector<std::string>& warnings) : names_(names), warnings_(warnings) {}

    /// The scope in which the cards that follow stand. What a *SYSTEM card said before does not count any more.
    void enter(const FlatScope& scope);

    /// The card in the flat deck; none if there is nothing left of it to write (*SYSTEM). Throws ReadError "file:line:
    /// ..." for what names something that is not there or could be several things, and for cards whose meaning in an
    /// instance that is turned, or numbered anew, is not known.
    std::optional<Card> flat(const Card& card);

private:
    void change_head(Card& card, const FlatScope& of) const;
    void change_nodes(Card& card) const;
    void change_elements(Card& card) const;
    void change_set(Card& card, const FlatScope& scope) const;
    void change_surface(Card& card) const;
    void change_equation(Card& card) const;
    void change_first(Card& card, std::size_t count, std::size_t from, Numbered what) const;
    void change_unknown(Card& card);
    void turn(Card& card) const;
    void turn_numbers(Card& card, std::size_t only_line, std::size_t from, bool points) const;
    void turn_orientation(Card& card, bool points) const;
    void turn_beam(Card& card) const;
    void translate(LineFields& line, std::size_t k, const FlatScope& scope, Numbered what, const Where& where) const;
    [[noreturn]] void refuse_turned(const std::string& where, const std::string& what) const;

    const FlatNames& names_;
    std::vector<std::string>& warnings_;
    const FlatScope* scope_ = nullptr;
    Placement system_;  // of the coordinates of nodes, in the scope
};

}  // namespace femscalpel
