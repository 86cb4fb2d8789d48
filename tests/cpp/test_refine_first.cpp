// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/refine_first.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "operators/refine_estimate.h"
#include "simple_meshes.h"
#include "tools/cylinder.h"
#include "tools/patch.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;
using When = RefineFirst::When;

const Plane plane({0, 0, 0}, {0, 0, 1});
const Cylinder cylinder({0, 0, 0}, {0, 0, 1}, 2);

/// Where a tool has no bound.
const std::function<double(const Vec3&)> everywhere;

TEST(ZoneAround, AToolIsHalfItsRadius) {
    const auto zone = zone_around(cylinder, everywhere, {});
    ASSERT_TRUE(zone);
    EXPECT_EQ(zone->size, 1);
    EXPECT_EQ(zone->distance({5, 0, 7}), 3);
    EXPECT_FALSE(zone_around(plane, everywhere, {})) << "a plane has no size";
    EXPECT_FALSE(zone_around(cylinder, everywhere, {When::never, 0}));
    const auto sized = zone_around(plane, everywhere, {When::to_size, 0.25});
    ASSERT_TRUE(sized);
    EXPECT_EQ(sized->size, 0.25);
    for (const double bad : {-1.0, 0.0, std::nan("")})
        EXPECT_THAT(
            [&] {
                zone_around(plane, everywhere, {When::to_size, bad});
            },
            testing::ThrowsMessage<ToolError>(HasSubstr("it must be a positive length")));
}

TEST(ZoneAround, AToolEndsWhereItIsBounded) {
    const auto zone = zone_around(cylinder, [](const Vec3& x) { return x.z() - 10; }, {});
    ASSERT_TRUE(zone);
    EXPECT_EQ(zone->distance({5, 0, 7}), 3);
    EXPECT_EQ(zone->distance({5, 0, 14}), 5) << "three from the cylinder, four beyond its end";
}

TEST(ZoneAround, APartOfAToolIsAllOfItOrItsFront) {
    const Patch disk = Disk({0, 0, 0}, 3).on(plane), half = HalfPlane({0, 0, 0}, {1, 0, 0}).on(plane);
    const auto all = zone_around(plane, disk, {});
    ASSERT_TRUE(all);
    EXPECT_EQ(all->size, 1.5);
    EXPECT_EQ(all->distance({1, 0, 0.5}), 0.5);
    EXPECT_EQ(all->distance({6, 0, 4}), 5);
    const auto front = zone_around(plane, disk, {When::to_size, 0.1});
    ASSERT_TRUE(front);
    EXPECT_EQ(front->size, 0.1);
    EXPECT_EQ(front->distance({0, 0, 4}), 5);
    EXPECT_FALSE(zone_around(plane, half, {}));
    EXPECT_FALSE(zone_around(plane, disk, {When::never, 0}));
}

/// Everywhere.
RefineZone zone(double size) {
    return {[](const Vec3&) { return 0.0; }, size};
}

TEST(RefineFirstTest, RefinesWhereTheMeshIsCoarser) {
    const Mesh mesh = checks::grid(1, 1, 1);
    const RefineZone fine[] = {zone(0.9)}, coarse[] = {zone(2)};
    const auto refined = refine_first(mesh, fine, {});
    ASSERT_TRUE(refined);
    EXPECT_FALSE(refined->tried_in_vain);
    EXPECT_EQ(refined->summary->size, 0.9);
    EXPECT_EQ(refined->summary->elements_before, 6);
    EXPECT_EQ(refined->summary->elements_after, refined->mesh.cell_count());
    EXPECT_GT(refined->mesh.cell_count(), 6);
    EXPECT_EQ(refined->numbering.node, 18);
    EXPECT_EQ(refined->numbering.cell, 106);
    EXPECT_TRUE(refined->report.warnings.empty());
    EXPECT_FALSE(refine_first(mesh, coarse, {})) << "it is fine enough";
    EXPECT_FALSE(refine_first(mesh, {}, {}));
    OperatorOptions deform;
    deform.method = Method::deform;
    EXPECT_FALSE(refine_first(mesh, fine, deform)) << "it is there not to add nodes";
    deform.refine = {When::to_size, 0.9};
    EXPECT_TRUE(refine_first(mesh, fine, deform)) << "it was asked for";
}

TEST(RefineFirstTest, CountsALargerZoneAsFartherAway) {
    // Of two zones the finer is far away: around the coarser one edges may be as long as that says.
    const Mesh mesh = checks::grid(1, 1, 1);
    const RefineZone zones[] = {{[](const Vec3& x) { return x.x() + 100; }, 0.1},
                                {[](const Vec3& x) { return x.x(); }, 1.6}};
    const auto refined = refine_first(mesh, zones, {});
    ASSERT_TRUE(refined) << "the diagonal is longer";
    EXPECT_EQ(refined->mesh.block(CellType::tetra).size(), 12);
}

TEST(RefineFirstTest, SaysSoWhereItMadeMany) {
    const Mesh mesh = checks::grid(4, 4, 4);
    const RefineZone zones[] = {zone(0.6)};
    const auto refined = refine_first(mesh, zones, {});
    ASSERT_TRUE(refined);
    EXPECT_THAT(
        refined->report.warnings,
        ElementsAre(testing::AllOf(HasSubstr("which was refined first, to edges of 0.6 near the tool: from 384"),
                                   HasSubstr("refine=1.2 makes fewer"))));
    OperatorOptions asked;
    asked.refine = {When::to_size, 0.6};
    EXPECT_TRUE(refine_first(mesh, zones, asked)->report.warnings.empty());
}

TEST(RefineFirstTest, TriesInVainWhereElementsCannotBeBisected) {
    Mesh mesh;
    for (int k = 0; k < 8; ++k) mesh.add_node(Vec3((k ^ (k >> 1)) & 1, k >> 1 & 1, k >> 2), k + 1);
    mesh.add_cell(CellType::hexahedron, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7}, 1);
    mesh.add_cell(CellType::triangle, std::array<Index, 3>{0, 1, 2}, 2);
    const RefineZone zones[] = {zone(0.5)};
    const auto refined = refine_first(mesh, zones, {});
    ASSERT_TRUE(refined);
    EXPECT_TRUE(refined->tried_in_vain);
    EXPECT_EQ(refined->mesh.cell_count(), 0);
    EXPECT_THAT(refined->report.warnings,
                ElementsAre(HasSubstr("the mesh is coarser than the tool, but was not refined first: ")));
    OperatorOptions asked;
    asked.refine = {When::to_size, 0.5};
    EXPECT_THROW(refine_first(mesh, zones, asked), UnsupportedElementError);
}

TEST(RefineEstimate, IsALowerBoundAndNearIt) {
    const Mesh mesh = checks::grid(4, 4, 4);
    const DistanceField distance = [](const Vec3& x) { return (x - Vec3(2, 2, 2)).norm() - 1; };
    RefineOptions options;
    options.size = 0.3;
    std::vector<RefinementEstimate> told;
    options.before = [&](const RefinementEstimate& e) { told.push_back(e); };
    const Index made = refine(mesh, distance, options).mesh.cell_count();
    const Index least = count_refined(mesh, SizeField(distance, options), most_counted);
    ASSERT_EQ(told.size(), 1U);
    EXPECT_EQ(told[0].elements_before, mesh.cell_count());
    EXPECT_EQ(told[0].elements_after, with_followers(mesh.cell_count(), least));
    EXPECT_LE(least, made);
    EXPECT_NEAR(static_cast<double>(told[0].elements_after), static_cast<double>(made),
                0.3 * static_cast<double>(made));
    EXPECT_EQ(count_refined(mesh, SizeField(distance, options), 500), 501) << "counting ends at the limit";
    EXPECT_THROW(told[0].size_for(1000), std::logic_error) << "the call is over";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
