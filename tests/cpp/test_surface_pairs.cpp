// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rule_testing.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using namespace deck_testing;
using namespace rule_testing;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class SurfacePairsRule : public RuleTest {};

TEST_F(SurfacePairsRule, SurfacesOfTiesContactAndLoadsFollow) {
    const auto on_top = [](const Vec3& p) { return p.z() == nz; };
    const auto on_end = [](const Vec3& p) { return p.x() == nx; };
    std::string top = "*SURFACE, NAME=TOP, TYPE=ELEMENT\n", end = "*SURFACE, NAME=END\n",
                nodes = "*SURFACE, NAME=BOTTOM, TYPE=NODE\n", set;
    for (const auto& [e, f] : top_faces()) top += std::to_string(e) + ", S" + std::to_string(f) + "\n";
    const Block b = block();
    for (std::size_t e = 0; e < b.tetras.size(); ++e)
        for (int f = 0; f < 4; ++f)
            if (std::ranges::all_of(solver_faces[f], [&](int v) { return b.tetras[e][v] % (nx + 1) == 0; }))
                end += std::to_string(e + 1) + ", S" + std::to_string(f + 1) + "\n";
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            nodes += std::to_string(node_at(i, j, 0)) + "\n";
            set += std::to_string(node_at(i, j, 2)) + ",\n";
        }
    const std::string naming =
        "*TIE, NAME=T1, POSITION TOLERANCE=.01\nBOTTOM, TOP\n*SURFACE INTERACTION, NAME=SI\n*SURFACE BEHAVIOR, "
        "PRESSURE-OVERCLOSURE=HARD\n"
        "*CONTACT PAIR, INTERACTION=SI, TYPE=NODE TO SURFACE\nHELD, TOP\n*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE "
        "TO SURFACE\nTOP, END\n"
        "*COUPLING, CONSTRAINT NAME=C1, SURFACE=TOP, REF NODE=900\n*KINEMATIC\n1, 3\n"
        "*STEP\n*STATIC\n*DSLOAD\nEND, P, 2.\n*SECTION PRINT, SURFACE=END, NAME=SP\nSOF\n*FACE PRINT, "
        "SURFACE=END\nSOF\n*CONTACT PRINT\nCDIS\n*END STEP\n";
    const Mesh mesh = block_with("*NODE\n900, 9., 9., 9.\n" + top + end + nodes + "*NSET, NSET=HELD_N\n" + set +
                                 "*SURFACE, NAME=HELD, TYPE=NODE\nHELD_N\n" + naming);
    ASSERT_NEAR(surface_area(mesh, "TOP", on_top), nx * ny, 1e-12);
    for (const double x : {1.5, 2.0, 2.3})
        for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(1, .3, .4), Vec3(.3, 1, .2)}) {
            SCOPED_TRACE(x);
            const Mesh after = crack_at(mesh, x, "CRACK", normal, true);  // strict: all of this is understood
            EXPECT_THAT(warnings_, Not(Contains(HasSubstr("deck.inp"))));
            EXPECT_NEAR(surface_area(after, "TOP", on_top), nx * ny, 1e-12);
            EXPECT_NEAR(surface_area(after, "END", on_end), ny * nz, 1e-12);
            for (const auto& [name, z] : {std::pair("BOTTOM", 0), std::pair("HELD", nz), std::pair("HELD_N", nz)}) {
                const auto found = node_set(after, name);
                EXPECT_EQ(std::set<Index>(found.begin(), found.end()),
                          nodes_where(after, [&](const Vec3& p) { return p.z() == z; }))
                    << name;
            }
            // The cards that name them say what they said.
            for (const char* keyword :
                 {"TIE", "CONTACTPAIR", "COUPLING", "KINEMATIC", "DSLOAD", "SECTIONPRINT", "FACEPRINT", "CONTACTPRINT"})
                EXPECT_EQ(text_of(after, keyword), text_of(mesh, keyword)) << keyword;
        }
}

TEST_F(SurfacePairsRule, FollowTheirGroups) {
    const std::string cards =
        "*SURFACE, NAME=S\n1, S1\n*SURFACE, NAME=T\n2, S2\n*TIE, NAME=X\nS, T\n*CLOAD\n1, 1, 1.\n";
    const Carried after = carried(cards, double_node_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings, IsEmpty());
}

TEST_F(SurfacePairsRule, EitherSurfaceWithoutMembersIsTold) {
    const std::string cards =
        "*SURFACE, NAME=S\n1, S1\n*SURFACE, NAME=T\n2, S2\n*TIE, NAME=X\nS, T\n*CONTACT PAIR, INTERACTION=I\nT, "
        "S\n*CLOAD\n1, 1, 1.\n";
    const Carried after = carried(cards, remove_element_2);
    EXPECT_EQ(after.cards, cards);
    EXPECT_THAT(after.warnings,
                ElementsAre("deck.inp:15: *TIE names element surface 'T', which lost all its members",
                            "deck.inp:17: *CONTACTPAIR names element surface 'T', which lost all its members"));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
