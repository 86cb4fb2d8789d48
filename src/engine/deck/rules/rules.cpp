// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/rules.h"

#include <algorithm>

#include "deck/rules/element_loads.h"
#include "deck/rules/element_values.h"
#include "deck/rules/equations.h"
#include "deck/rules/face_equations.h"
#include "deck/rules/foreign_results.h"
#include "deck/rules/initial_motions.h"
#include "deck/rules/mesh_cards.h"
#include "deck/rules/model_changes.h"
#include "deck/rules/mpcs.h"
#include "deck/rules/nameless_cards.h"
#include "deck/rules/nodal_fields.h"
#include "deck/rules/node_loads.h"
#include "deck/rules/normals.h"
#include "deck/rules/point_values.h"
#include "deck/rules/reference_nodes.h"
#include "deck/rules/submodels.h"
#include "deck/rules/supports.h"
#include "deck/rules/surface_pairs.h"

namespace femscalpel {
namespace {

using Make = std::unique_ptr<CardRule> (*)();

template <class Rule>
std::unique_ptr<CardRule> make() {
    return std::make_unique<Rule>();
}

/// A new card is a rule in a file of its own and a line here. The first rule that takes a card has it: those of single
/// types stand before those of the rest.
constexpr Make table[] = {
    make<MeshCards>,       //
    make<ForeignResults>,  // of fields and supports only those from files
    make<Supports>,        //
    make<InitialMotions>,  // of *INITIAL CONDITIONS, as the next
    make<PointValues>,     //
    make<ElementValues>,   //
    make<NodalFields>,     // and of all other *INITIAL CONDITIONS
    make<Submodels>,       //
    make<NodeLoads>,       //
    make<ElementLoads>,    //
    make<ModelChanges>,    //
    make<Normals>,         //
    make<Equations>,       //
    make<FaceEquations>,   //
    make<Mpcs>,            //
    make<ReferenceNodes>,  //
    make<SurfacePairs>,    //
    make<NamelessCards>,   // compares first letters only: the last
};

}  // namespace

CardRules::CardRules() {
    for (const Make make_rule : table) rules_.push_back(make_rule());
}

CardRule* CardRules::find(const Card& card) const {
    const auto it = std::ranges::find_if(rules_, [&](const auto& rule) { return rule->takes(card); });
    return it == rules_.end() ? nullptr : it->get();
}

}  // namespace femscalpel
