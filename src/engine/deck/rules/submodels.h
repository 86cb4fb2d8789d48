// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/nodal_rule.h"

namespace femscalpel {

/// *SUBMODEL: the nodes that get what the global model has there, a list. With TYPE=SURFACE it names surfaces.
class Submodels : public NodalRule {
public:
    bool takes(const Card& card) const override { return card.keyword == "SUBMODEL"; }
    bool can_change(const Card& card) const override { return type_of(card) != "SURFACE"; }
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

protected:
    std::optional<Values> read_values(CardReader& line, const Card& card, Remarks& remarks) const override;
    std::vector<std::string> lines(Index number, const Values& wanted, const Values& given) const override;
};

}  // namespace femscalpel
