// SPDX-License-Identifier: LGPL-2.1-or-later
#include <map>
#include "mesh/quality.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class ElementValuesRule : public RuleTest {};

TEST_F(ElementValuesRule, ElementValuesGoToAllParts) {
    std::string stress, distribution, change;
    for (int e = 1; e <= 96; ++e) {
        stress += std::to_string(e) + ", 1, " + std::to_string(e) + ".5, 0., 0., 0., 0., 0.\n";
        distribution += std::to_string(e) + ", 1., 0., 0., 0., 1., " + std::to_string(e) + ".\n";
        change += std::to_string(e) + (e % 8 == 0 ? "\n" : ", ");
    }
    const Mesh mesh = block_with("*DISTRIBUTION, NAME=D\n, 1., 0., 0., 0., 1., 0.\n" + distribution +
                                 "*DEPVAR\n8\n*INITIAL CONDITIONS, TYPE=STRESS\n" + stress +
                                 "*STEP\n*STATIC\n*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n" + change + "*END STEP\n");
    const Mesh after = crack_at(mesh, 1.6, "CRACK", Vec3(1, .3, .5));
    const std::vector<Index> all = element_set(after, "EALL");
    ASSERT_GT(all.size(), 96u);
    EXPECT_EQ(rows(after, "INITIALCONDITIONS").size(), all.size());
    EXPECT_EQ(rows(after, "DISTRIBUTION").size(), all.size() + 1);
    std::set<Index> changed;
    for (const Row& r : rows(after, "MODELCHANGE"))
        for (const std::string& entry : r) changed.insert(std::stoll(entry));
    EXPECT_EQ(changed, std::set<Index>(all.begin(), all.end()));
    // Parts have the value of the element they lie in.
    const NumberIndex old_numbers(mesh), new_numbers(after);
    std::map<double, double> volume;
    for (const Row& r : rows(after, "INITIALCONDITIONS")) {
        const CellRef c = *new_numbers.cell(std::stoll(r[0]));
        volume[std::stod(r[2])] += cell_measure(after, c.type, c.cell);
    }
    EXPECT_EQ(volume.size(), 96u);
    EXPECT_THAT(warnings_, Not(Contains(HasSubstr("deck.inp"))));
}

TEST_F(ElementValuesRule, RecordsOverSeveralLinesStayTogether) {
    const Mesh mesh = block_with(
        "*DEPVAR\n8\n*INITIAL CONDITIONS, TYPE=SOLUTION\n"
        "9, 1, 1., 2., 3., 4., 5., 6.\n7., 8.\n10, 1, 11., 2., 3., 4., 5., 6.\n17., 18.\n");
    Mesh after = mesh;
    Changes changes;
    const CellBlock& tetras = after.block(CellType::tetra);
    const std::vector<Index> nodes(tetras.nodes(8).begin(), tetras.nodes(8).end());
    after.add_cell(CellType::tetra, nodes, 1000, tetras.families[8]);
    changes.parts.push_back({1000, 9});
    (void)carry_deck(mesh, after, changes);
    EXPECT_THAT(rows(after, "INITIALCONDITIONS"),
                ElementsAre(ElementsAre("9", "1", "1.", "2.", "3.", "4.", "5.", "6."), ElementsAre("7.", "8."),
                            ElementsAre("1000", "1", "1.", "2.", "3.", "4.", "5.", "6."), ElementsAre("7.", "8."),
                            ElementsAre("10", "1", "11.", "2.", "3.", "4.", "5.", "6."), ElementsAre("17.", "18.")));
}

TEST_F(ElementValuesRule, PartsGetWhatTheElementHas) {
    const Carried after = carried(
        "*DISTRIBUTION, NAME=D\n, 1., 0., 0., 0., 1., 0.\n1, 0., 1., 0., 0., 0., 1.\n*INITIAL CONDITIONS, TYPE=PLASTIC "
        "STRAIN\n"
        "1, 1, .1, .2, .3, 0., 0., 0.\n2, 1, .4, 0., 0., 0., 0., 0.\n",
        halve_element_1);
    EXPECT_EQ(after.cards,
              "*DISTRIBUTION, NAME=D\n, 1., 0., 0., 0., 1., 0.\n1, 0., 1., 0., 0., 0., 1.\n3, 0., 1., 0., 0., 0., 1.\n"
              "*INITIAL CONDITIONS, TYPE=PLASTIC STRAIN\n1, 1, .1, .2, .3, 0., 0., 0.\n3, 1, .1, .2, .3, 0., 0., "
              "0.\n2, 1, .4, 0., "
              "0., 0., 0., 0.\n");
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(ElementValuesRule, RemovedElementsAreToldAndTheirRecordsGoWhole) {
    const Carried after = carried(
        "*DEPVAR\n7\n*INITIAL CONDITIONS, TYPE=SOLUTION\n2, 1, 1., 2., 3., 4., 5., 6.\n7.\n1, 1, 11., 12., 13., 14., "
        "15., 16.\n17.\n",
        remove_element_2);
    EXPECT_EQ(after.cards, "*DEPVAR\n7\n*INITIAL CONDITIONS, TYPE=SOLUTION\n1, 1, 11., 12., 13., 14., 15., 16.\n17.\n");
    EXPECT_THAT(after.warnings, ElementsAre("deck.inp:13: *INITIALCONDITIONS names element 2, which was removed"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
