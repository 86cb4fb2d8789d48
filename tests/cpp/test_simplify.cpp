// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/simplify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "groups/group_report.h"
#include "mesh/order.h"
#include "mesh/quality.h"
#include "random_numbers.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::bricks;
using checks::members;
using checks::number_near;
using checks::quadrangles;
using testing::ElementsAre;

Simplified simplified(const Mesh& mesh, const Vec3& at) {
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    level[static_cast<std::size_t>(number_near(mesh, at))] = 0;
    Simplified out = simplify(mesh, plan_conversion(mesh, level, nullptr), next_numbers(mesh));
    out.mesh.validate();
    return out;
}

double measure(const Mesh& mesh, int dimension) {
    double sum = 0;
    for (const CellBlock& b : mesh.blocks())
        if (traits(b.type).dimension == dimension)
            for (Index c = 0; c < b.size(); ++c) {
                const double m = cell_measure(mesh, b.type, c);
                EXPECT_GT(m, 0) << traits(b.type).name << " " << b.ids[c];
                sum += m;
            }
    return sum;
}

/// How often each face of a solid is there, by its corners.
std::map<std::vector<Index>, int> faces(const Mesh& mesh) {
    std::map<std::vector<Index>, int> out;
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; traits(b.type).dimension == 3 && c < b.size(); ++c)
            for (const ElementFace& f : faces_of(mesh, {b.type, c})) {
                std::vector<Index> key(f.corners.begin(), f.corners.begin() + f.count);
                std::ranges::sort(key);
                ++out[key];
            }
    return out;
}

TEST(Simplify, AQuadrangleKeepsItsNumberAndItsEdges) {
    for (const bool second : {false, true}) {
        Mesh mesh = quadrangles(2, 1);
        const FamilyIndex left = checks::family_of(mesh, "LEFT", GroupKind::element);
        mesh.block(CellType::quad).families[0] = left;
        mesh.facets = {{CellType::quad, 2, checks::family_of(mesh, "TOP", GroupKind::facet), 0},
                       {CellType::quad, 5, checks::family_of(mesh, "SIDE", GroupKind::facet), 0}};
        if (second) mesh = to_second_order(mesh);
        const Simplified out = simplified(mesh, {0, 0, 0});
        EXPECT_THAT(members(out.mesh, "LEFT", GroupKind::element), ElementsAre(1, 3));
        EXPECT_EQ(out.converted[static_cast<int>(second ? CellType::quad8 : CellType::quad)], 1);
        EXPECT_EQ(out.mesh.block(second ? CellType::triangle6 : CellType::triangle).size(), 2);
        EXPECT_EQ(out.nodes_added, second);
        ASSERT_EQ(out.changes.parts.size(), 1u);
        EXPECT_EQ(out.changes.parts[0].element, 3);
        EXPECT_EQ(out.changes.parts[0].parent, 1);
        EXPECT_NEAR(measure(out.mesh, 2), 2, 1e-14);
        const auto top = group_members(out.mesh, *out.mesh.find_group("TOP", GroupKind::facet)),
                   side = group_members(out.mesh, *out.mesh.find_group("SIDE", GroupKind::facet));
        EXPECT_THAT(top.ids, ElementsAre(1, 3));
        EXPECT_THAT(top.faces, ElementsAre(2, 2));
        ASSERT_EQ(side.ids.size(), 1u);
        // The side opposite the first: y = 1.
        const Facet& f = *std::ranges::find_if(out.mesh.facets, [](const Facet& x) { return x.face > 2; });
        const auto n = out.mesh.block(f.type).nodes(f.cell);
        EXPECT_EQ(out.mesh.points[n[f.face - 3]].y(), 1);
        EXPECT_EQ(out.mesh.points[n[(f.face - 2) % 3]].y(), 1);
    }
}

TEST(Simplify, SolidsConformAndFillTheSameSpace) {
    checks::Random random(7);
    for (const bool second : {false, true})
        for (int round = 0; round < 4; ++round) {
            Mesh mesh = bricks(5, 4, 4);
            for (Vec3& x : mesh.points)
                if (x.minCoeff() > 0 && x[0] < 5 && x[1] < 4 && x[2] < 4 && round > 0)
                    for (int k = 0; k < 3; ++k) x[k] += 0.2 * random.uniform(-1, 1);
            const FamilyIndex top = checks::family_of(mesh, "TOP", GroupKind::facet);
            for (Index c = 0; c < mesh.cell_count(); ++c) mesh.facets.push_back({CellType::hexahedron, 3, top, c});
            if (second) mesh = to_second_order(mesh);
            const Simplified out = simplified(mesh, {0, 0, 0});
            EXPECT_GT(out.pyramids, 0);
            EXPECT_NEAR(measure(out.mesh, 3), 80, round > 0 ? 0.05 : 1e-12);
            double skin = 0;
            for (const auto& [face, count] : faces(out.mesh)) {
                ASSERT_LE(count, 2);
                if (count == 2) continue;
                const auto on = [&](int axis, double at) {
                    return std::ranges::all_of(face, [&](Index n) { return out.mesh.points[n][axis] == at; });
                };
                ASSERT_TRUE(on(0, 0) || on(0, 5) || on(1, 0) || on(1, 4) || on(2, 0) || on(2, 4));
                skin += face.size() == 3 ? 0.5 : 1;
            }
            EXPECT_EQ(skin, 112);
            double kept = 0, was = 0;
            for (const Facet& f : out.mesh.facets) kept += facet_measure(out.mesh, f);
            for (const Facet& f : mesh.facets) was += facet_measure(mesh, f);
            EXPECT_NEAR(kept, was, round > 0 ? 0.05 * was : 1e-12);
            for (const CellType type : {CellType::tetra, CellType::tetra10, CellType::pyramid, CellType::pyramid13})
                for (const double q : mean_ratios(out.mesh, type)) EXPECT_GT(q, 0.15);
        }
}

TEST(Simplify, NodesOfABentShellStayOnIt) {
    Mesh mesh = to_second_order(quadrangles(3, 2));
    for (Vec3& x : mesh.points) x[2] = 0.1 * x[0] * x[0];
    const Simplified out = simplified(mesh, {0, 0, 0});
    for (const Vec3& x : out.mesh.points) EXPECT_NEAR(x[2], 0.1 * x[0] * x[0], 1e-14);
    ASSERT_EQ(out.changes.born.size(), 1u);
    double sum = 0;
    for (const auto& [node, share] : out.changes.born[0].shares) sum += share;
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_EQ(out.changes.born[0].ancestors.size(), 4u);
}

TEST(Simplify, NewNodesAreInTheGroupsOfAllCorners) {
    Mesh mesh = to_second_order(bricks(1, 1, 1));
    const FamilyIndex all = checks::family_of(mesh, "ALL", GroupKind::node),
                      top = mesh.families.with(all, mesh.add_group("TOP", GroupKind::node));
    for (std::size_t n = 0; n < mesh.points.size(); ++n) mesh.node_families[n] = mesh.points[n].z() == 1 ? top : all;
    const Simplified out = simplified(mesh, {0, 0, 0});
    EXPECT_EQ(out.nodes_added, 7);
    EXPECT_EQ(members(out.mesh, "ALL", GroupKind::node).size(), 27u);
    EXPECT_EQ(members(out.mesh, "TOP", GroupKind::node).size(), 9u);
}

TEST(Simplify, MiddlesOfFacesBecomeMidSideNodesOrGo) {
    Mesh mesh;
    const auto add = [&](std::vector<Vec3> at) {
        std::vector<Index> out;
        for (const Vec3& x : at) out.push_back(mesh.add_node(x, mesh.node_count() + 1));
        return out;
    };
    const std::vector<Index>
        quad = add({{0, 0, 0},
                    {1, 0, 0},
                    {1, 1, 0},
                    {0, 1, 0},
                    {0.5, 0, 0},
                    {1, 0.5, 0},
                    {0.5, 1, 0},
                    {0, 0.5, 0},
                    {0.52, 0.5, 0}}),
        triangle = add({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.5, 0, 1}, {0.5, 0.5, 1}, {0, 0.5, 1}, {0.33, 0.33, 1}});
    mesh.add_cell(CellType::quad9, quad, 1);
    mesh.add_cell(CellType::triangle7, triangle, 2);
    std::vector<std::int8_t> level(mesh.points.size(), 0);
    const Simplified out = simplify(mesh, plan_conversion(mesh, level, nullptr), next_numbers(mesh));
    out.mesh.validate();
    EXPECT_EQ(out.nodes_added, 0);
    EXPECT_EQ(out.nodes_removed, 1);
    EXPECT_EQ(out.mesh.block(CellType::triangle6).size(), 3);
    EXPECT_EQ(std::ranges::count(out.mesh.block(CellType::triangle6).connectivity, 8), 2);
    EXPECT_EQ(out.converted[static_cast<int>(CellType::triangle7)], 1);
}

TEST(Simplify, AnElementInsideOutByItsShapeIsNamed) {
    Mesh mesh = bricks(1, 1, 1);
    mesh.points[7] = Vec3(-3, -3, -3);  // the mean ratio of a corner is negative: it is left to the operator to say so
    EXPECT_NO_THROW(simplified(mesh, {0, 0, 0}));
    mesh = quadrangles(1, 1);
    mesh.block(CellType::quad).connectivity = {0, 1, 1, 0};
    EXPECT_THAT(
        [&] {
            simplified(mesh, {0, 0, 0});
        },
        testing::ThrowsMessage<UnsupportedElementError>(testing::HasSubstr("element 1, a quad")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
