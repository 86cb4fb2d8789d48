// SPDX-License-Identifier: LGPL-2.1-or-later
// Which rule has which card; what the rules do is in the test of each.
#include "deck/rules/rules.h"

#include <typeindex>

#include "deck/rules/card_rule.h"
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
#include "deck/rules/nodal_rule.h"
#include "deck/rules/node_loads.h"
#include "deck/rules/normals.h"
#include "deck/rules/point_values.h"
#include "deck/rules/reference_nodes.h"
#include "deck/rules/submodels.h"
#include "deck/rules/supports.h"
#include "deck/rules/surface_pairs.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace rule_testing;

Card card(const std::string& text) {
    Card out;
    out.set_text(text + "\n");
    return out;
}

TEST(CardRules, HaveEachCardInOnePlace) {
    const CardRules rules;
    const std::vector<std::pair<std::type_index, std::vector<std::string>>> table{
        {typeid(MeshCards), {"*NODE", "*ELEMENT, TYPE=S3", "*NSET, NSET=A", "*ELSET, ELSET=A", "*SURFACE, NAME=A"}},
        {typeid(Supports), {"*BOUNDARY"}},
        {typeid(InitialMotions), {"*INITIAL CONDITIONS, TYPE=DISPLACEMENT", "*INITIAL CONDITIONS, TYPE=VELOCITY"}},
        {typeid(PointValues),
         {"*INITIAL CONDITIONS, TYPE=STRESS", "*INITIAL CONDITIONS, TYPE=PLASTIC STRAIN",
          "*INITIAL CONDITIONS, TYPE=SOLUTION"}},
        {typeid(ElementValues), {"*DISTRIBUTION"}},
        {typeid(NodalFields), {"*TEMPERATURE", "*NODAL THICKNESS", "*INITIAL CONDITIONS, TYPE=TEMPERATURE"}},
        {typeid(Submodels), {"*SUBMODEL"}},
        {typeid(NodeLoads), {"*CLOAD", "*CFLUX", "*DISTRIBUTING COUPLING", "*RETAINED NODAL DOFS"}},
        {typeid(ElementLoads), {"*DLOAD", "*DFLUX", "*FILM", "*RADIATE", "*MASS FLOW", "*BOUNDARYF"}},
        {typeid(ModelChanges), {"*MODEL CHANGE, TYPE=ELEMENT"}},
        {typeid(Normals), {"*NORMAL"}},
        {typeid(Equations), {"*EQUATION", "*NETWORK MPC"}},
        {typeid(FaceEquations), {"*EQUATIONF"}},
        {typeid(Mpcs), {"*MPC"}},
        {typeid(ReferenceNodes), {"*RIGID BODY", "*COUPLING", "*PRE-TENSION SECTION"}},
        {typeid(SurfacePairs), {"*TIE", "*CONTACT PAIR"}},
        {typeid(ForeignResults),
         {"*RESTART, READ", "*VIEWFACTOR, READ", "*INITIAL MESH", "*TEMPERATURE, FILE=A", "*SENSITIVITY",
          "*MODAL DYNAMIC", "*FREQUENCY"}},
        {typeid(NamelessCards), {"*STATIC", "*MATERIAL, NAME=M", "*SOLID SECTION, ELSET=A"}},
    };
    EXPECT_EQ(rules.all().size(), table.size());
    for (const auto& [type, cards] : table)
        for (const std::string& text : cards) {
            const CardRule* rule = rules.find(card(text));
            ASSERT_NE(rule, nullptr) << text;
            EXPECT_EQ(std::type_index(typeid(*rule)).name(), type.name()) << text;
        }
    EXPECT_EQ(rules.find(card("*NOTACARD")), nullptr);
}

TEST(CardRules, SayHowManySetsALineNames) {
    EXPECT_EQ(Supports().names_per_line(), 1);
    EXPECT_EQ(SurfacePairs().names_per_line(), 2);
    EXPECT_EQ(MeshCards().names_per_line(), 0);
    EXPECT_EQ(Equations().names_per_line(), 0) << "it tells of sets itself";
}

TEST(CardRules, SayWhatCanChange) {
    EXPECT_TRUE(Supports().can_change(card("*BOUNDARY")));
    EXPECT_TRUE(ModelChanges().can_change(card("*MODEL CHANGE, TYPE=ELEMENT")));
    EXPECT_FALSE(ModelChanges().can_change(card("*MODEL CHANGE, TYPE=CONTACT PAIR")));
    EXPECT_FALSE(Submodels().can_change(card("*SUBMODEL, TYPE=SURFACE")));
    EXPECT_TRUE(Submodels().can_change(card("*SUBMODEL, TYPE=NODE")));
    EXPECT_FALSE(SurfacePairs().can_change(card("*TIE")));
    EXPECT_FALSE(MeshCards().can_change(card("*NODE")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
