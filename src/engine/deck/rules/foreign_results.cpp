// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/foreign_results.h"

#include "deck/rules/carrying.h"

namespace femscalpel {

bool ForeignResults::takes(const Card& card) const {
    return card.keyword == "RESTART" || card.keyword == "VIEWFACTOR" || card.keyword == "INITIALMESH";
}

bool ForeignResults::can_change(const Card& card) const { return card.keyword != "RESTART" || card.parameter("READ"); }

void ForeignResults::carry(std::size_t /*c*/, const Card& card, Carrying& carrying) {
    Remarks& remarks = carrying.remarks();
    if (card.keyword == "INITIALMESH") {
        remarks.add_problem(card.where() +
                            ": *INITIAL MESH says where the nodes were in a first mesh, which has no new nodes; leave "
                            "it out, or give it theirs");
    } else if (card.keyword == "RESTART") {
        if (card.parameter("READ"))
            remarks.add_problem(card.where() + ": *" + card.keyword +
                                ", READ needs results of the mesh as it was; the changed mesh has other nodes and "
                                "elements");
    } else if (card.parameter("READ") && !view_factors_made_) {
        remarks.add_problem(card.where() +
                            ": *VIEWFACTOR, READ needs view factors of the mesh as it was; compute them anew");
    } else {
        view_factors_made_ = true;
    }
}

}  // namespace femscalpel
