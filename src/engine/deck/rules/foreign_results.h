// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// Results of the mesh as it was that the deck reads, by numbers of nodes and elements, so that what is new has none:
/// *RESTART and *SENSITIVITY, READ; *TEMPERATURE and other fields with FILE=; *VIEWFACTOR, READ, unless an earlier
/// *VIEWFACTOR of the deck makes them; steps on eigenmodes, unless an earlier *FREQUENCY does. That they are of another
/// mesh is told. What is read by place, as *SUBMODEL does, is right for new nodes, too.
class ForeignResults : public CardRule {
public:
    bool takes(const Card& card) const override;
    bool can_change(const Card& card) const override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

private:
    bool view_factors_made_ = false, modes_made_ = false;
};

}  // namespace femscalpel
