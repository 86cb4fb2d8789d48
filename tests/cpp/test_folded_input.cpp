// SPDX-License-Identifier: LGPL-2.1-or-later
// A cube of eight in second-order elements, of which a mid-side node lies too near one end of its edge.
#include "cutting/folded_input.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/mend_curved.h"
#include "simple_meshes.h"
#include "tools/plane.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::node_at;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Plane away({100, 0, 0}, {1, 0, 0});

/// The node in the middle of the edge from (1, 1, 1) along x is off it by `shift`, towards its end: the Jacobian of the
/// six elements there has its smallest ratio at that end's corner, 1 - 4 shift.
struct Folded {
    explicit Folded(double shift) : mesh(shifted(shift)), f(checks::whole_workpiece(mesh, away)) {}

    static Mesh shifted(double shift) {
        Mesh mesh = checks::second_order(checks::grid(2, 2, 2));
        mesh.points[checks::number_near(mesh, {1.5, 1, 1})].x() += shift;
        return mesh;
    }
    bool is_moved() const { return f.d.mids.is_mended(middle, end); }
    std::vector<BandElement> elements() const {
        std::vector<BandElement> out;
        for (const auto& [key, folded] : f.folded_input) out.push_back({key.first, key.second});
        return out;
    }

    Mesh mesh;
    Workpiece f;
    int middle = node_at(f.d.band, {1, 1, 1}), end = node_at(f.d.band, {2, 1, 1});
};

TEST(FoldedInput, IsFoundAtCornersThatSolversDoNotLookAt) {
    Folded cube(0.26);
    find_folded_input(cube.f, cube.mesh);
    ASSERT_EQ(cube.f.folded_input.size(), 6u);
    for (const auto& [key, folded] : cube.f.folded_input) {
        EXPECT_FALSE(key.first);
        EXPECT_NEAR(folded.ratio, 1 - 4 * 0.26, 1e-12);
        EXPECT_FALSE(folded.mended);
        const CellRef cell = cube.f.d.band.tetra_cells[key.second];
        EXPECT_EQ(folded.id, cube.mesh.block(cell.type).ids[cell.cell]);
    }
}

TEST(FoldedInput, IsNoneInSoundElements) {
    Folded cube(0.1);
    find_folded_input(cube.f, cube.mesh);
    EXPECT_THAT(cube.f.folded_input, IsEmpty());
}

TEST(FoldedInput, IsAnErrorWhereSolversIntegrate) {
    Folded cube(0.6);
    EXPECT_THAT([&] { find_folded_input(cube.f, cube.mesh); },
                testing::ThrowsMessage<QualityError>(
                    AllOf(HasSubstr("6 second-order elements"), HasSubstr("where solvers integrate"))));
}

TEST(FoldedInput, IsMendedAndPutBackWhereNothingNeededThat) {
    Folded cube(0.26);
    find_folded_input(cube.f, cube.mesh);
    EXPECT_THAT([&] { check_folded_input(cube.f, cube.elements()); },
                testing::ThrowsMessage<QualityError>(HasSubstr("6 second-order elements in the way")));
    mend_folded_input(cube.f);
    EXPECT_TRUE(cube.is_moved());
    for (const auto& [key, folded] : cube.f.folded_input) {
        EXPECT_TRUE(folded.mended);
        EXPECT_GE(curved_shape(cube.f.d, {key.first, key.second}), curved_limit);
    }
    EXPECT_NO_THROW(check_folded_input(cube.f, cube.elements()));
    put_back_middles(cube.f, cube.mesh);
    EXPECT_FALSE(cube.is_moved());
    EXPECT_NEAR(cube.f.d.mids.bulge(cube.middle, cube.end).x(), 0.26, 1e-12);
    EXPECT_THAT(cube.f.warnings, ElementsAre(AllOf(HasSubstr("6 second-order elements near the tool, folded"),
                                                   HasSubstr("those that were not cut stay as they are"))));
}

TEST(FoldedInput, StaysMendedWhereElementsChanged) {
    Folded cube(0.26);
    find_folded_input(cube.f, cube.mesh);
    mend_folded_input(cube.f);
    cube.f.d.band.nodes[cube.middle].at.y() += 0.01;
    put_back_middles(cube.f, cube.mesh);
    EXPECT_TRUE(cube.is_moved());
    const Index number = cube.mesh.node_ids[checks::number_near(cube.mesh, {1.76, 1, 1})];
    EXPECT_THAT(cube.f.warnings, ElementsAre(HasSubstr("1 mid-side node was moved towards the middle of their "
                                                       "edges (node " +
                                                       std::to_string(number) + ")")));
}

TEST(FoldedInput, IsNotNewlyFolded) {
    Folded cube(0.26);
    find_folded_input(cube.f, cube.mesh);
    EXPECT_THAT(newly_folded(cube.f, cube.elements()), IsEmpty());
    BandElement other{false, 0};
    while (cube.f.folded_input.contains({false, other.slot})) ++other.slot;
    EXPECT_THAT(newly_folded(cube.f, {other}), ElementsAre(other)) << "it was not in the input";
    cube.f.d.mids.set_bulge(cube.middle, cube.end, Vec3(0.3, 0, 0));
    EXPECT_EQ(newly_folded(cube.f, cube.elements()).size(), 6u) << "worse than they were";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
