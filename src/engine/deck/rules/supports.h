// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/nodal_rule.h"

namespace femscalpel {

/// *BOUNDARY: node, first degree of freedom, last, value. Nodes by number with one value on cards of one step form a
/// group whose shape is kept, so that what is held stays an area or a line.
class Supports : public NodalRule {
public:
    bool takes(const Card& card) const override { return card.keyword == "BOUNDARY"; }
    void mark(std::size_t c, const Card& card, Marking& marking) override;

protected:
    std::optional<Values> read_values(CardReader& line, const Card& card, Remarks& remarks) const override;
    std::vector<std::string> lines(Index number, const Values& wanted, const Values& given) const override;
    bool is_along_beams() const override { return false; }
};

}  // namespace femscalpel
