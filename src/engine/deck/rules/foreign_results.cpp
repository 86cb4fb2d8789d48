// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/foreign_results.h"

#include <algorithm>

#include "deck/rules/carrying.h"

namespace femscalpel {
namespace {

/// Cards whose values FILE= takes from results. With lines of their own they are as without it: CalculiX passes over
/// FILE= where it does not know it.
bool is_field_from_file(const Card& card) {
    constexpr std::string_view keywords[] = {"BOUNDARY", "INITIALCONDITIONS", "NODALTHICKNESS", "TEMPERATURE"};
    return std::ranges::find(keywords, card.keyword) != std::end(keywords) && card.parameter("FILE") &&
           !CardReader(card).next_data_line();
}

bool is_on_modes(const Card& card) {
    constexpr std::string_view keywords[] = {"COMPLEXFREQUENCY", "MODALDYNAMIC", "STEADYSTATEDYNAMICS"};
    return std::ranges::find(keywords, card.keyword) != std::end(keywords);
}

}  // namespace

bool ForeignResults::takes(const Card& card) const {
    constexpr std::string_view keywords[] = {"FREQUENCY", "INITIALMESH", "RESTART", "SENSITIVITY", "VIEWFACTOR"};
    return std::ranges::find(keywords, card.keyword) != std::end(keywords) || is_on_modes(card) ||
           is_field_from_file(card);
}

bool ForeignResults::can_change(const Card& card) const {
    if (card.keyword == "RESTART" || card.keyword == "SENSITIVITY") return card.parameter("READ");
    return card.keyword != "FREQUENCY";
}

void ForeignResults::carry(std::size_t /*c*/, const Card& card, Carrying& carrying) {
    const auto tell = [&](const std::string& what) { carrying.remarks().add_problem(card.where() + ": *" + what); };
    if (card.keyword == "INITIALMESH") {
        tell(
            "INITIAL MESH says where the nodes were in a first mesh, which has no new nodes; leave it out, or give it "
            "theirs");
    } else if (card.keyword == "RESTART" || card.keyword == "SENSITIVITY") {
        if (card.parameter("READ"))
            tell(card.keyword +
                 ", READ needs results of the mesh as it was; the changed mesh has other nodes and elements");
    } else if (card.keyword == "FREQUENCY") {
        modes_made_ = true;
    } else if (is_on_modes(card)) {
        if (!modes_made_)
            tell(card.keyword +
                 " needs eigenmodes of the mesh as it was, as no *FREQUENCY of the deck makes them "
                 "before; compute them anew");
    } else if (is_field_from_file(card)) {
        tell(card.keyword +
             ", FILE takes values by number from results of the mesh as it was: new nodes have none "
             "there, and CalculiX gives them zero; compute them anew");
    } else if (card.parameter("READ") && !view_factors_made_) {
        tell("VIEWFACTOR, READ needs view factors of the mesh as it was; compute them anew");
    } else {
        view_factors_made_ = true;
    }
}

}  // namespace femscalpel
