// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_vertex.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/quality.h"
#include "operators/fillet.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

struct Corner {
    std::vector<FilletVertex> vertices;
    std::vector<std::unique_ptr<FilletPath>> owned;
    std::vector<const FilletPath*> paths;
};

/// The edges near some points, and where they meet.
Corner corner_of(const Mesh& mesh, const std::vector<Vec3>& near, double radius) {
    const auto skin = skin_of(mesh);
    const std::vector<FeatureLine> lines = find_feature_lines(mesh, {{}, {}, near}, 30);
    Corner out{find_vertices(mesh, lines, skin), {}, {}};
    for (std::size_t k = 0; k < lines.size(); ++k) {
        FilletEnds ends;
        for (const FilletVertex& v : out.vertices)
            for (const auto& m : v.members)
                if (m.edge == k) {
                    ends.kind[m.which] = LineEnd::joined;
                    ends.to_centre[m.which] = v.to_centre;
                }
        out.owned.push_back(std::make_unique<FilletPath>(mesh, lines[k], radius, skin, ends));
        out.paths.push_back(out.owned.back().get());
    }
    return out;
}

TEST(FilletVertex, ThreeEdgesOfABox) {
    Corner corner = corner_of(checks::grid(5, 4, 4), {{2.4, 0, 0}, {0, 2.4, 0}, {0, 0, 2.4}}, 1.5);
    ASSERT_EQ(corner.vertices.size(), 1U);
    FilletVertex& v = corner.vertices[0];
    EXPECT_TRUE(v.right_angled);
    EXPECT_FALSE(v.is_mitre());
    v.join(corner.paths);
    EXPECT_LT((v.centre - Vec3(1.5, 1.5, 1.5)).norm(), 1e-12);
    ASSERT_TRUE(v.sphere);
    EXPECT_NEAR(v.sphere->radius(), 1.5, 1e-12);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& [edge, which] = v.members[k];
        EXPECT_NEAR(corner.paths[edge]->cut_back(which), 1.5, 1e-12);
        EXPECT_NEAR(corner.paths[edge]->cut_back(1 - which), 0, 1e-12);
        EXPECT_NEAR(v.across[k].maxCoeff(), 1, 1e-12) << "away from the corner";
    }
}

TEST(FilletVertex, TwoEdgesMeetInThePlaneThroughTheThird) {
    Corner corner = corner_of(checks::grid(5, 4, 4), {{2.4, 0, 0}, {0, 2.4, 0}}, 1.5);
    ASSERT_EQ(corner.vertices.size(), 1U);
    FilletVertex& v = corner.vertices[0];
    EXPECT_TRUE(v.is_mitre());
    v.join(corner.paths);
    EXPECT_FALSE(v.sphere);
    EXPECT_NEAR(std::abs(v.across[0].dot(Vec3(1, -1, 0).normalized())), 1, 1e-12);
    EXPECT_NEAR(v.across[0].dot(v.centre), 0, 1e-12);
}

TEST(FilletVertex, EdgesThatDoNotMeetHaveNone) {
    EXPECT_TRUE(corner_of(checks::grid(5, 4, 4), {{2.4, 0, 0}, {2.4, 4, 4}}, 1.5).vertices.empty());
}

TEST(FilletVertex, TwoEdgesBetweenFacesAtDifferentAnglesAreARefusal) {
    Mesh mesh = checks::grid(5, 4, 4);
    for (Vec3& x : mesh.points) x.x() += 0.3 * x.z();
    Corner corner = corner_of(mesh, {{2.4, 0, 0}, {0, 2.4, 0}}, 1);
    ASSERT_EQ(corner.vertices.size(), 1U);
    EXPECT_FALSE(corner.vertices[0].right_angled);
    try {
        corner.vertices[0].join(corner.paths);
        FAIL();
    } catch (const ToolError& e) {
        EXPECT_STREQ(e.parameter(), "along");
        EXPECT_THAT(e.what(), testing::HasSubstr("different angles"));
    }
}

TEST(FilletVertex, RoundedCubeHasTheVolumeOfTheFormula) {
    const Mesh mesh = checks::second_order(checks::grid(4, 4, 4));
    Along along;
    for (const double a : {0.0, 4.0})
        for (const double b : {0.0, 4.0}) along.points.insert(along.points.end(), {{2, a, b}, {a, 2, b}, {a, b, 2}});
    const Result result = fillet(mesh, along, 1);
    double volume = 0;
    for (Index c = 0; c < result.mesh.block(CellType::tetra10).size(); ++c)
        volume += cell_measure(result.mesh, CellType::tetra10, c);
    const double expected = 8 + 2 * 3 * 4 + M_PI * 6 + 4.0 / 3 * M_PI;
    EXPECT_NEAR(volume, expected, 0.001 * (64 - expected));
    const CellBlock& face = result.mesh.block(CellType::triangle6);
    for (Index c = 0; c < face.size(); ++c)
        for (const Index n : face.nodes(c)) {
            const Vec3& x = result.mesh.points[n];
            EXPECT_NEAR((x - x.cwiseMax(1).cwiseMin(3)).norm(), 1, 1e-9) << "mid-side nodes, too";
        }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
