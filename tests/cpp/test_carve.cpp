// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/carve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/quality.h"
#include "simple_meshes.h"
#include "tools/plane.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array<const char*, 4> sets{"IN", "EN", "ITN", "ETN"};

TEST(Body, IsWithinAllItsWalls) {
    const Plane in_x({1, 0, 0}, {1, 0, 0}), in_y({0, 2, 0}, {0, 1, 0});
    const Body body{{{&in_x, {"_X"}}, {&in_y, {"_Y"}}}};
    EXPECT_EQ(body.depth({0, 0, 0}), -1);
    EXPECT_EQ(body.depth({0.5, 1.75, 0}), -0.25);
    EXPECT_EQ(body.depth({0.5, 5, 0}), 3);
}

struct Carve : testing::Test {
    Result carved(const std::vector<Body>& bodies) const { return carve("notch", mesh, bodies, options, sets, {}); }
    template <class Call>
    static void expect_error(Call call, const char* why) {
        EXPECT_THAT(call, testing::ThrowsMessage<ToolError>(HasSubstr(why)));
    }
    Carve() { options.name = "N"; }
    Mesh mesh = checks::grid(4, 4, 2);
    Plane in_x{{2, 0, 0}, {1, 0, 0}}, in_y{{0, 2, 0}, {0, 1, 0}}, far{{9, 0, 0}, {1, 0, 0}};
    OperatorOptions options;
};

TEST_F(Carve, TakesBodiesOut) {
    const Result result = carved({{{{&in_x, {"_X", "_ALL"}}, {&in_y, {"_Y", "_ALL"}}}}});
    result.mesh.validate();
    double volume = 0;
    const CellBlock& tetras = result.mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c) volume += cell_measure(result.mesh, CellType::tetra, c);
    EXPECT_NEAR(volume, 32 - 8, 1e-12);
    EXPECT_EQ(checks::members(result.mesh, "N_X", GroupKind::element).size(), 8u);
    EXPECT_EQ(checks::members(result.mesh, "N_ALL", GroupKind::element).size(), 16u);
    EXPECT_EQ(result.report.operation, "notch");
    EXPECT_EQ(result.report.elements_removed, 48);
    EXPECT_TRUE(result.report.node_sets.contains("IN"));
    EXPECT_TRUE(result.report.warnings.empty());
}

TEST_F(Carve, LeavesOutWallsBeyondThePart) {
    const Result result = carved({{{{&in_x, {"_X"}}, {&far, {"_FAR"}}}}});
    EXPECT_THAT(result.report.warnings, ElementsAre(HasSubstr("the wall FAR (plane) lies beyond the part")));
    EXPECT_FALSE(result.mesh.find_group("N_FAR"));
    EXPECT_TRUE(result.mesh.find_group("N_X"));
}

TEST_F(Carve, RefusesWhatTakesAllOrNothing) {
    expect_error([&] { carved({}); }, "there is no tool");
    expect_error([&] { carved({{{{&far, {"_FAR"}}}}}); }, "the plane would remove the whole mesh");
    const Plane outside({0, 0, 0}, {1, 0, 0});
    expect_error([&] { carved({{{{&outside, {"_X"}}}}}); }, "the plane removes nothing: it touches the mesh");
    options.method = Method::deform;
    expect_error([&] { carved({{{{&in_x, {"_X"}}, {&in_y, {"_Y"}}}}}); }, "works with a single surface");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
