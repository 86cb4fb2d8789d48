// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/nodal_rule.h"

namespace femscalpel {

/// Fields at nodes, node and values: *TEMPERATURE, *NODAL THICKNESS, *INITIAL CONDITIONS of temperatures, pressures and
/// whatever else has no rule of its own.
class NodalFields : public NodalRule {
public:
    bool takes(const Card& card) const override;

protected:
    std::optional<Values> read_values(CardReader& line, const Card& card, Remarks& remarks) const override;
    std::vector<std::string> lines(Index number, const Values& wanted, const Values& given) const override;
    bool tells_of_made(const Card& card) const override;
};

}  // namespace femscalpel
