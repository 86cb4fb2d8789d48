// SPDX-License-Identifier: LGPL-2.1-or-later
// What nodes of a cube of tetrahedra may do, with and without tools.
#include "deformation/node_constraints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simple_meshes.h"
#include "tools/plane.h"
#include "tools/sphere.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::number_near;
using testing::ElementsAre;
using testing::IsEmpty;

/// The band of all of a mesh, marked.
struct Held {
    explicit Held(const Mesh& mesh, const ConstraintOptions& options = {})
        : band(extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0))), constraints(band, mesh, options) {
        constraints.geometry().mark(band);
    }

    int node(const Vec3& at) const {
        for (int v = 0; v < band.size(); ++v)
            if ((band.nodes[v].at - at).norm() < 1e-9) return v;
        throw Error("no node there");
    }
    NodeFreedom freedom(const Vec3& at) const { return constraints[node(at)].freedom; }

    int split(const Vec3& a, const Vec3& b) {
        const int made = band.split_edge(node(a), node(b), (a + b) / 2);
        constraints.add_node(band, made);
        return made;
    }

    BandMesh band;
    NodeConstraints constraints;
};

TEST(NodeConstraints, HaveThePlaceOfTheGeometry) {
    const Held held(checks::two_halves());
    EXPECT_EQ(held.freedom({1, 1, 1}), NodeFreedom::surface);
    EXPECT_EQ(held.freedom({1, 1, 0}), NodeFreedom::curve);
    EXPECT_EQ(held.freedom({1, 0, 0}), NodeFreedom::fixed);
    EXPECT_EQ(held.freedom({0, 1, 1}), NodeFreedom::surface);
    EXPECT_TRUE(std::isinf(held.constraints.leash(held.node({1, 1, 0}))));
}

TEST(NodeConstraints, GroupsThatDriftHoldNothing) {
    Mesh mesh = checks::two_halves();
    ConstraintOptions options;
    options.drifting_groups = {true, true};
    EXPECT_EQ(Held(mesh, options).freedom({1, 1, 1}), NodeFreedom::free);
    options.drifting_groups = {true, false};
    EXPECT_EQ(Held(mesh, options).freedom({1, 1, 1}), NodeFreedom::surface);
    options = {};
    options.meaningless = {true, true};
    EXPECT_EQ(Held(mesh, options).freedom({1, 1, 1}), NodeFreedom::free);
    for (Group& g : mesh.groups) g.hidden = true;
    EXPECT_EQ(Held(mesh).freedom({1, 1, 1}), NodeFreedom::free);
    options = {};
    options.kept_hidden = {true, false};
    EXPECT_EQ(Held(mesh, options).freedom({1, 1, 1}), NodeFreedom::surface);
    options.kept_hidden = {false, false};
    EXPECT_EQ(Held(mesh, options).freedom({1, 1, 1}), NodeFreedom::free);
}

TEST(NodeConstraints, WhatElseHoldsNodes) {
    Mesh mesh = checks::grid(2, 2, 2);
    ConstraintOptions options;
    options.pinned = {number_near(mesh, {1, 1, 1})};
    EXPECT_EQ(Held(mesh, options).freedom({1, 1, 1}), NodeFreedom::fixed);
    EXPECT_EQ(Held(mesh, options).freedom({1, 1, 0}), NodeFreedom::surface);
    mesh.add_cell(CellType::vertex, std::array{number_near(mesh, {1, 1, 0})}, 5000);
    mesh.node_families[number_near(mesh, {1, 1, 2})] = checks::family_of(mesh, "ALONE", GroupKind::node);
    const FamilyIndex rods = checks::family_of(mesh, "RODS", GroupKind::element);
    const Index outside = mesh.add_node({-1, 1, 1}, 6000);
    mesh.add_cell(CellType::line, std::array{number_near(mesh, {0, 1, 1}), outside}, 5001, rods);
    mesh.add_cell(CellType::line, std::array{number_near(mesh, {1, 1, 1}), number_near(mesh, {2, 1, 1})}, 5002, rods);
    options = {};
    options.drifting_groups = {false, true};  // the lines are no curves to be kept
    const Held held(mesh, options);
    EXPECT_EQ(held.freedom({1, 1, 0}), NodeFreedom::fixed) << "a point element";
    EXPECT_EQ(held.freedom({1, 1, 2}), NodeFreedom::fixed) << "the only node of a group";
    EXPECT_EQ(held.freedom({0, 1, 1}), NodeFreedom::fixed) << "a beam hangs on it";
    EXPECT_EQ(held.freedom({1, 1, 1}), NodeFreedom::free);
    EXPECT_TRUE(held.constraints.is_loose(0));
    EXPECT_FALSE(held.constraints.is_loose(1)) << "an edge of tetrahedra";
    EXPECT_THAT(held.constraints.groups_at(held.band, held.node({1, 1, 2})), ElementsAre(0));
    EXPECT_THAT(held.constraints.groups_at(held.band, held.node({1, 1, 0})), IsEmpty());
}

TEST(NodeConstraints, MiddlesOfGroupsAndPinnedOnesAreFixed) {
    Mesh mesh = checks::second_order(checks::grid(1, 1, 1));
    EXPECT_FALSE(Held(mesh).constraints.has_fixed_middles());
    mesh.node_families[number_near(mesh, {0.5, 0, 0})] = checks::family_of(mesh, "MIDDLE", GroupKind::node);
    ConstraintOptions options;
    options.pinned = {number_near(mesh, {0.5, 0.5, 0.5})};
    const Held held(mesh, options);
    const auto fixed = [&](const Vec3& a, const Vec3& b) {
        return held.constraints.has_fixed_middle(held.node(a), held.node(b));
    };
    EXPECT_TRUE(fixed({1, 0, 0}, {0, 0, 0}));
    EXPECT_TRUE(fixed({0, 0, 0}, {1, 1, 1}));
    EXPECT_FALSE(fixed({0, 0, 1}, {1, 0, 1}));
}

TEST(NodeConstraints, NewNodesKeepToWhatTheirEdgeWasOn) {
    Held held(checks::two_halves());
    const auto of = [&](int node) { return held.constraints[node].freedom; };
    const int on_edge = held.split({0, 0, 0}, {1, 0, 0}), on_skin = held.split({0, 1, 1}, {0, 1, 0}),
              inside = held.split({0, 1, 1}, {1, 1, 1}), on_border = held.split({1, 1, 1}, {1, 0, 1});
    EXPECT_EQ(of(on_edge), NodeFreedom::curve);
    EXPECT_EQ(of(on_skin), NodeFreedom::surface);
    EXPECT_EQ(of(inside), NodeFreedom::free);
    EXPECT_EQ(of(on_border), NodeFreedom::surface);
    EXPECT_TRUE(held.constraints.is_exterior(on_skin));
    EXPECT_FALSE(held.constraints.is_exterior(inside));
    EXPECT_FALSE(held.constraints.is_exterior(on_border));
    EXPECT_TRUE(held.constraints.is_on_internal(held.band, on_border));
    EXPECT_TRUE(std::isinf(held.constraints.leash(on_edge)));
    // The parts of the edge are still on it.
    const NodeConstraint part = held.constraints.on_edge(held.band, on_edge, held.node({1, 0, 0}));
    EXPECT_EQ(part.freedom, NodeFreedom::curve);
    EXPECT_EQ(part.shape, held.constraints[on_edge].shape);
}

TEST(NodeConstraints, NodesBornBetweenRelatedOnesOnTheSkinAreFixed) {
    const Mesh mesh = checks::grid(2, 2, 2);
    ConstraintOptions options;
    for (const Vec3& x : {Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(1, 1, 1)}) options.related.push_back(number_near(mesh, x));
    std::ranges::sort(options.related);
    Held held(mesh, options);
    EXPECT_TRUE(held.constraints.is_related_edge(held.band, held.node({1, 1, 0}), held.node({2, 1, 0})));
    EXPECT_FALSE(held.constraints.is_related_edge(held.band, held.node({1, 1, 0}), held.node({1, 1, 1}))) << "inside";
    const int on_skin = held.split({1, 1, 0}, {2, 1, 0}), inside = held.split({1, 1, 0}, {1, 1, 1}),
              other = held.split({1, 1, 0}, {0, 1, 0});
    EXPECT_EQ(held.constraints[on_skin].freedom, NodeFreedom::fixed);
    EXPECT_EQ(held.constraints[inside].freedom, NodeFreedom::free);
    EXPECT_EQ(held.constraints[other].freedom, NodeFreedom::surface);
    EXPECT_TRUE(held.constraints.is_related(on_skin) && held.constraints.is_related(inside));
    EXPECT_FALSE(held.constraints.is_related(other));
}

TEST(NodeConstraints, EdgesAndNodesAreOnTheSkinOrOnBorders) {
    const Held held(checks::two_halves());
    const NodeConstraints& c = held.constraints;
    const auto at = [&](double x, double y, double z) { return held.node({x, y, z}); };
    EXPECT_TRUE(c.is_skin_edge(held.band, at(0, 1, 1), at(0, 1, 0)));
    EXPECT_TRUE(c.is_exterior_edge(held.band, at(0, 1, 1), at(0, 1, 0)));
    EXPECT_FALSE(c.is_skin_edge(held.band, at(1, 1, 1), at(1, 0, 1)));
    EXPECT_FALSE(c.is_exterior_edge(held.band, at(1, 1, 1), at(1, 0, 1)));
    EXPECT_TRUE(c.is_internal_edge(held.band, at(1, 1, 1), at(1, 0, 1)));
    EXPECT_FALSE(c.is_internal_edge(held.band, at(0, 1, 1), at(1, 1, 1)));
    EXPECT_FALSE(c.is_internal_edge(held.band, at(0, 1, 1), at(0, 1, 0)));
    EXPECT_TRUE(c.is_on_skin(held.band, at(1, 1, 0)));
    EXPECT_TRUE(c.is_on_internal(held.band, at(1, 1, 0)));
    EXPECT_FALSE(c.is_on_skin(held.band, at(1, 1, 1)));
    EXPECT_TRUE(c.is_exterior(at(1, 1, 0)));
    EXPECT_FALSE(c.is_exterior(at(1, 1, 1)));
    EXPECT_EQ(c.on_face(held.band, at(1, 1, 1), at(1, 0, 1), at(1, 0, 0)).freedom, NodeFreedom::surface);
    EXPECT_EQ(c.on_face(held.band, at(0, 0, 0), at(1, 0, 0), at(1, 1, 1)).freedom, NodeFreedom::free);
}

TEST(NodeConstraints, APlateIsExteriorAtItsBorder) {
    Mesh mesh;
    checks::add_plate(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 2, 2);
    const Held held(mesh);
    EXPECT_TRUE(held.constraints.is_shell(0));
    EXPECT_FALSE(held.constraints.is_exterior(held.node({1, 1, 0})));
    EXPECT_TRUE(held.constraints.is_exterior(held.node({1, 0, 0})));
    EXPECT_TRUE(held.constraints.is_exterior_edge(held.band, held.node({1, 0, 0}), held.node({2, 0, 0})));
    EXPECT_FALSE(held.constraints.is_exterior_edge(held.band, held.node({1, 0, 0}), held.node({1, 1, 0})));
    Mesh solid = checks::grid(1, 1, 1);
    checks::add_plate(solid, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 1, 1);
    EXPECT_FALSE(Held(solid).constraints.is_shell(0)) << "a face of a tetrahedron";
}

TEST(NodeConstraints, NodesAreCountedByGroup) {
    const Held held(checks::two_halves());
    std::vector<int> nodes;
    for (int v = 0; v < held.band.size(); ++v) nodes.push_back(v);
    const auto counts = held.constraints.count_by_group(held.band, nodes, 2);
    ASSERT_EQ(counts.size(), 2u);
    for (const auto& c : counts) {
        // Half the cube: 18 nodes; the middles of its end and of the border slide on them.
        EXPECT_EQ(c.surface, 2);
        EXPECT_EQ(c.line, 8);
        EXPECT_EQ(c.fixed, 8);
    }
    EXPECT_THAT(held.constraints.groups_at(held.band, held.node({1, 1, 1})), ElementsAre(0, 1));
    EXPECT_THAT(held.constraints.groups_at(held.band, held.node({0, 1, 1})), ElementsAre(0));
}

TEST(NodeConstraints, ProjectMeetsTheToolsWithinTheShape) {
    const Held held(checks::grid(2, 2, 2));
    const NodeConstraints& c = held.constraints;
    const int on_skin = held.node({1, 1, 0}), on_edge = held.node({1, 0, 0}), corner = held.node({0, 0, 0}),
              inside = held.node({1, 1, 1});
    const Plane slant({1.2, 0, 0}, {1, 0.2, 0.3}), other({0, 0.9, 0}, {0.1, 1, 0.2});
    const Sphere sphere({1, 1, -0.3}, 0.5);

    Vec3 x(1, 1, 0);
    EXPECT_TRUE(c.project(on_skin, &slant, x));
    EXPECT_LT(std::abs(x[2]) + std::abs(slant.distance(x)), 1e-13);
    x = Vec3(1.1, 1.2, 0.1);
    EXPECT_TRUE(c.project(on_skin, &sphere, x));
    EXPECT_LT(std::abs(x[2]) + std::abs(sphere.distance(x)), 1e-13);
    x = Vec3(1, 1, 0);
    EXPECT_TRUE(c.project(on_skin, Contact(&slant).with(&other), x));
    EXPECT_LT(std::abs(x[2]) + std::abs(slant.distance(x)) + std::abs(other.distance(x)), 1e-13);
    x = Vec3(1, 0, 0);
    EXPECT_TRUE(c.project(on_edge, &slant, x));
    EXPECT_LT((x - Vec3(1.2, 0, 0)).norm(), 1e-13);
    x = Vec3(1, 1, 1);
    EXPECT_TRUE(c.project(inside, &sphere, x));
    EXPECT_LT((x - Vec3(1, 1, 0.2)).norm(), 1e-13) << "the closest point";
    x = Vec3(1.3, 1, 1);
    EXPECT_TRUE(c.project(inside, {}, x));
    EXPECT_EQ(x, Vec3(1.3, 1, 1));
    EXPECT_TRUE(c.project(on_edge, {}, x));
    EXPECT_LT((x - Vec3(1.3, 0, 0)).norm(), 1e-15);

    x = Vec3::Zero();
    EXPECT_FALSE(c.project(corner, &slant, x));
    const Plane through({0, 0, 0}, {1, 2, 3});
    EXPECT_TRUE(c.project(corner, &through, x));
    x = Vec3(1, 0, 0);
    EXPECT_FALSE(c.project(on_edge, Contact(&slant).with(&other), x)) << "they do not meet on the edge";
}

TEST(NodeConstraints, ToolsAlongTheShapeAddNothingIfTheyLieOnIt) {
    const Held held(checks::grid(2, 2, 2));
    const NodeConstraint on_skin = held.constraints[held.node({1, 1, 0})];
    const Plane on({0, 0, 1e-12}, {0, 0, 1}), beside({0, 0, 1e-4}, {0, 0, 1}), across({1.2, 0, 0}, {1, 0, 0.5});
    Vec3 x(1, 1, 0);
    EXPECT_TRUE(held.constraints.project(on_skin, &on, x));
    EXPECT_NEAR(on.distance(x), 0, 1e-15) << "the tool is what counts";
    x = Vec3(1, 1, 0);
    EXPECT_TRUE(held.constraints.project(on_skin, Contact(&on).with(&across), x));
    EXPECT_LT(std::abs(across.distance(x)), 1e-13);
    x = Vec3(1, 1, 0);
    EXPECT_FALSE(held.constraints.project(on_skin, &beside, x));
    x = Vec3(1, 1, 0);
    EXPECT_TRUE(held.constraints.project(on_skin, &beside, x, 1e-4)) << "held beside it";
    EXPECT_EQ(x, Vec3(1, 1, 0));
}

TEST(NodeConstraints, TangentsAreTheDirectionsLeft) {
    const Held held(checks::grid(2, 2, 2));
    const NodeConstraints& c = held.constraints;
    const Plane slant({1, 1, 0}, {1, 0.2, 0.3}), other({1, 1, 0}, {0.1, 1, 0.2}), top({0, 0, 0}, {0, 0, 1});
    const Vec3 x(1, 1, 0);
    Eigen::Matrix3d basis;
    const auto expect = [&](int node, const Contact& tools, int count, std::vector<Vec3> normals) {
        ASSERT_EQ(c.tangents(node, tools, x, basis), count);
        const auto columns = basis.leftCols(count);
        EXPECT_TRUE((columns.transpose() * columns).isIdentity(1e-12));
        for (const Vec3& n : normals) EXPECT_LT((columns.transpose() * n).norm(), 1e-12);
    };
    const int inside = held.node({1, 1, 1}), on_skin = held.node({1, 1, 0}), on_edge = held.node({1, 0, 0});
    expect(inside, {}, 3, {});
    expect(inside, &slant, 2, {slant.normal(x)});
    expect(inside, Contact(&slant).with(&other), 1, {slant.normal(x), other.normal(x)});
    expect(on_skin, {}, 2, {Vec3::UnitZ()});
    expect(on_skin, &slant, 1, {Vec3::UnitZ(), slant.normal(x)});
    expect(on_skin, &top, 2, {Vec3::UnitZ()});
    expect(on_skin, Contact(&slant).with(&other), 0, {});
    expect(on_edge, {}, 1, {Vec3::UnitY(), Vec3::UnitZ()});
    expect(on_edge, &slant, 0, {});
    expect(held.node({0, 0, 0}), {}, 0, {});
}

TEST(NodeConstraints, DistanceIsThatToTheShape) {
    const Held held(checks::grid(2, 2, 2));
    const NodeConstraints& c = held.constraints;
    const Vec3 x(1.3, 0.4, -0.3);
    EXPECT_NEAR(c.distance(c[held.node({1, 1, 0})], x), 0.3, 1e-15);
    EXPECT_NEAR(c.distance(c[held.node({1, 0, 0})], x), 0.5, 1e-15);
    EXPECT_EQ(c.distance(c[held.node({1, 1, 1})], x), 0);
    EXPECT_NEAR(std::abs((*c.surface_normal(c[held.node({1, 1, 0})], x))[2]), 1, 1e-15);
    EXPECT_FALSE(c.surface_normal(c[held.node({1, 0, 0})], x));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
