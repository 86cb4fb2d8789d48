// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/nodal_rule.h"

namespace femscalpel {

/// *INITIAL CONDITIONS of displacements and velocities: node, degree of freedom, value.
class InitialMotions : public NodalRule {
public:
    bool takes(const Card& card) const override;

protected:
    std::optional<Values> read_values(CardReader& line, const Card& card, Remarks& remarks) const override;
    std::vector<std::string> lines(Index number, const Values& wanted, const Values& given) const override;
};

}  // namespace femscalpel
