// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// The last CalculiX whose cards are known.
inline constexpr std::string_view latest_calculix = "2.23";

/// The first CalculiX that has a card, if that is one after 2.20; empty for others, and for those that none has.
std::string_view first_calculix_with(std::string_view keyword);

/// Whether a card that CalculiX does not have is one of Abaqus' materials, sections, procedures and outputs whose lines
/// have numbers of no node or element, nor directions.
bool is_nameless_in_abaqus(std::string_view keyword);

/// Cards of CalculiX up to 2.23 whose lines name no node or element by number: none at all, or sets and surfaces, which
/// follow the mesh's groups. CalculiX compares the first letters of keywords ("*FLUID SECTIONS"), and so does this.
class NamelessCards : public CardRule {
public:
    bool takes(const Card& card) const override;
    bool can_change(const Card& /*card*/) const override { return false; }
};

}  // namespace femscalpel
