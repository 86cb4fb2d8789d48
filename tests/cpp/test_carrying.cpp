// SPDX-License-Identifier: LGPL-2.1-or-later
// What the rules of the cards have to work with: what is marked before a change, and what is known after it.
#include "deck/rules/carrying.h"

#include "deck/rules/closed_sets.h"
#include "deck/rules/emptied_sets.h"
#include "deck/rules/loaded_faces.h"
#include "deck/rules/marking.h"
#include "deck/rules/remarks.h"
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace rule_testing;
using deck_testing::node_set;

class CarryingTest : public RuleTest {
protected:
    struct Changed {
        Changed(const Mesh& mesh, Change change) : before(mesh), after(mesh) { change(after, changes); }
        Mesh before, after;
        Changes changes;
    };
};

TEST_F(CarryingTest, KnowsWhatBecameOfNodesAndElements) {
    Changed halved(two_tetras(""), halve_element_1);
    halved.after.points[4].x() += 0.5;
    Carrying carrying(halved.before, halved.after, halved.changes);
    EXPECT_FALSE(carrying.node_gone(5));
    EXPECT_FALSE(carrying.node_gone(6)) << "it is new";
    EXPECT_TRUE(carrying.node_moved(5));
    EXPECT_FALSE(carrying.node_moved(1));
    EXPECT_TRUE(carrying.had_element(1));
    EXPECT_FALSE(carrying.had_element(3));
    EXPECT_THAT(carrying.parts_of(1), ElementsAre(1, 3));
    EXPECT_THAT(carrying.parts_of(2), ElementsAre(2));
    EXPECT_TRUE(carrying.has_further_parts(1));
    EXPECT_FALSE(carrying.has_further_parts(2));
    EXPECT_EQ(carrying.origin_of(3), 1);
    EXPECT_EQ(carrying.origin_of(2), 2);
    EXPECT_FALSE(carrying.is_plane_now(3));
    EXPECT_EQ(carrying.result(), halved.before.companion) << "nothing was edited";
    Changed removed(two_tetras(""), remove_element_2);
    EXPECT_TRUE(Carrying(removed.before, removed.after, removed.changes).node_gone(5));
    EXPECT_THAT(Carrying(removed.before, removed.after, removed.changes).parts_of(2), IsEmpty());
}

TEST_F(CarryingTest, EditsACopyOfTheDeck) {
    Changed doubled(two_tetras("*CLOAD\n2, 1, 1.\n"), double_node_2);
    Carrying carrying(doubled.before, doubled.after, doubled.changes);
    const std::vector<Card>& cards = carrying.old().cards();
    carrying.edits(cards.size() - 1).append(cards.back(), "6, 1, 2.");
    const auto deck = std::dynamic_pointer_cast<const SolverInput>(carrying.result());
    ASSERT_TRUE(deck);
    std::string text;
    for (const DeckText& t : deck->cards().back().text) text += t.text;
    EXPECT_EQ(text, "*CLOAD\n2, 1, 1.\n6, 1, 2.\n");
    EXPECT_EQ(deck_testing::text_of(doubled.before, "CLOAD"), "*CLOAD\n2, 1, 1.\n");
}

TEST_F(CarryingTest, ClosedSetsHaveOnlyOldMembers) {
    Changed doubled(two_tetras("*NSET, NSET=ENDS\n2, 3\n*NSET, NSET=OTHERS\n4\n"), double_node_2);
    ASSERT_THAT(node_set(doubled.after, "ENDS"), ElementsAre(2, 3, 6)) << "the copy has joined";
    Carrying carrying(doubled.before, doubled.after, doubled.changes);
    ClosedSets& sets = carrying.closed_sets();
    EXPECT_EQ(sets.name_of_old_members("OTHERS"), "OTHERS");
    EXPECT_EQ(sets.name_of_old_members("NOSUCH"), "NOSUCH");
    EXPECT_FALSE(sets.any());
    EXPECT_EQ(sets.name_of_old_members("ENDS"), "ENDS_LOAD1");
    EXPECT_EQ(sets.name_of_old_members("ends"), "ENDS_LOAD1") << "once for all";
    EXPECT_TRUE(sets.any());
    EXPECT_THAT(node_set(doubled.after, "ENDS_LOAD1"), ElementsAre(2, 3));
    EXPECT_EQ(sets.lost_members("ENDS"), 0);
    // Under a further change they stay as they are.
    doubled.after.companion = carrying.result();
    Changes further;
    Mesh again = doubled.after;
    again.add_node(again.points[2], 7, again.node_families[2]);
    further.copies.push_back({7, 3});
    ASSERT_THAT(node_set(again, "ENDS_LOAD1"), ElementsAre(2, 3, 7));
    const Carrying second(doubled.after, again, further);
    EXPECT_THAT(node_set(again, "ENDS_LOAD1"), ElementsAre(2, 3));
    EXPECT_THAT(node_set(again, "ENDS"), ElementsAre(2, 3, 6, 7));
}

TEST_F(CarryingTest, ClosedSetsCountLostMembers) {
    Changed removed(two_tetras("*NSET, NSET=ENDS\n2, 5\n"), remove_element_2);
    Carrying carrying(removed.before, removed.after, removed.changes);
    EXPECT_EQ(carrying.closed_sets().lost_members("ENDS"), 1);
    EXPECT_EQ(carrying.closed_sets().lost_members("NOSUCH"), 0);
}

TEST_F(CarryingTest, EmptiedSetsAreTold) {
    const Mesh mesh = two_tetras("*ELSET, ELSET=E\n2\n*ELSET, ELSET=STAYS\n1\n*NSET, NSET=NONE\n");
    Changed removed(mesh, remove_element_2);
    const SolverInput& deck = *solver_input(mesh);
    const EmptiedSets emptied(deck, removed.before, removed.after);
    EXPECT_FALSE(emptied.none());
    EXPECT_TRUE(EmptiedSets(deck, removed.before, removed.before).none());
    Card card;
    card.set_text("*SOLID SECTION, ELSET=e, MATERIAL=M\nSTAYS\nE\nSTAYS, E\n");
    const auto told = [&](int names_per_line) {
        Remarks remarks(deck);
        emptied.tell(0, card, names_per_line, remarks);
        return remarks.problems();
    };
    EXPECT_THAT(told(0), IsEmpty());
    EXPECT_THAT(told(1), ElementsAre(testing::HasSubstr("element set 'e', which lost all its members")))
        << "named twice";
    EXPECT_THAT(told(2), ElementsAre(testing::HasSubstr("element set 'e', which")));
}

TEST_F(CarryingTest, RemarksOnACardAreOne) {
    const Mesh mesh = two_tetras("*CLOAD\n1, 1, 1.\n*BOUNDARY\n1, 1\n");
    const SolverInput& deck = *solver_input(mesh);
    const std::size_t boundary = deck.cards().size() - 1, load = boundary - 1;
    Remarks remarks(deck);
    remarks.add(boundary, Weight::problem, "deck.inp:13: ", the_node(1), "was removed");
    remarks.add(load, Weight::problem, "deck.inp:11: ", the_node(2), "was removed");
    remarks.add(load, Weight::problem, "deck.inp:12: ", the_node(3), "was removed");
    remarks.add(load, Weight::problem, "deck.inp:12: ", the_set("A"), "grew");
    remarks.add(load, Weight::note, "deck.inp:12: ", the_element(4), "was split");
    remarks.add_problem("something else");
    EXPECT_THAT(remarks.problems(),
                ElementsAre("something else", "deck.inp:12: *CLOAD names set 'A', which grew",
                            "deck.inp:11: *CLOAD names node 2 and 1 more, each of which was removed",
                            "deck.inp:13: *BOUNDARY names node 1, which was removed"));
    EXPECT_THAT(remarks.notes(), ElementsAre("deck.inp:12: *CLOAD names element 4, which was split"));
}

TEST_F(CarryingTest, MarksBecomeHiddenGroups) {
    const Mesh mesh = two_tetras("*NSET, NSET=A\n1\n");
    Marking marking(mesh);
    marking.pin(5);
    marking.pin(99);  // the mesh has not
    marking.pin_related(2);
    marking.mark_node("held", 1);
    marking.mark_node("held", 3);
    marking.mark_element("loaded", 2);
    marking.mark_face("pressed", 1, 2);
    marking.mark_face("pressed", 2, 3);
    const DeckMarks marks = marking.result();
    EXPECT_THAT(marks.pinned, ElementsAre(1, 4)) << "indices";
    EXPECT_THAT(marks.related, ElementsAre(1));
    ASSERT_TRUE(marks.mesh);
    std::map<std::string, std::vector<Index>> members;
    for (std::size_t g = 0; g < marks.kept.size(); ++g) {
        EXPECT_EQ(marks.kept[g], g >= mesh.groups.size());
        if (marks.kept[g]) {
            EXPECT_TRUE(marks.mesh->groups[g].hidden);
            members[marks.mesh->groups[g].name] = group_members(*marks.mesh, static_cast<GroupIndex>(g)).ids;
        }
    }
    const std::string prefix(mark_prefix);
    EXPECT_THAT(members, ElementsAre(Pair(prefix + "held", ElementsAre(1, 3)), Pair(prefix + "loaded", ElementsAre(2)),
                                     Pair(prefix + "pressed", ElementsAre(1, 2))));
    Mesh unmarked = *marks.mesh;
    remove_marks(unmarked);
    EXPECT_EQ(unmarked.groups.size(), mesh.groups.size());
    EXPECT_FALSE(Marking(mesh).result().mesh) << "nothing is marked";
}

TEST_F(CarryingTest, LoadedFacesAreThoseInMarkedGroups) {
    const Mesh mesh = two_tetras("");
    Marking marking(mesh);
    marking.mark_face("pressed", 1, 1);
    marking.mark_element("heavy", 2);
    const Mesh before = *marking.result().mesh;
    Mesh after = before;
    Changes changes;
    halve_element_1(after, changes);
    LoadedFaces halved(before, after);
    EXPECT_THAT(halved.now("pressed"), ElementsAre(Pair(1, 1), Pair(3, 1)));
    EXPECT_THAT(halved.now("heavy"), ElementsAre(Pair(2, 0)));
    EXPECT_THAT(halved.now("nothing"), IsEmpty());
    EXPECT_FALSE(halved.shrank("pressed"));
    after.points[3].z() = 0.5;  // a corner of the heavy element
    LoadedFaces smaller(before, after);
    EXPECT_TRUE(smaller.shrank("heavy"));
    EXPECT_FALSE(smaller.shrank("pressed")) << "S1 is in z = 0";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
