// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/solid_parts.h"

#include <gtest/gtest.h>

#include "mesh/order.h"
#include "mesh/quality.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

class SolidPartsOf : public testing::Test {
protected:
    SolidParts cut(Mesh mesh, CellType type, bool on_base = false) {
        Conversion conversion;
        conversion.cells[static_cast<int>(type)] = {0};
        const auto n = mesh.block(type).nodes(0);
        if (on_base) conversion.bases.emplace(quad_key({n[0], n[1], n[2], n[3]}), 1);
        mesh_ = std::move(mesh);
        QuadCuts cuts(mesh_, conversion.cells,
                      [&](const Blend& at, const auto&) { return mesh_.add_node(place_of(mesh_, at), ++number_); });
        return cut_solid(mesh_, {type, 0}, conversion, cuts);
    }

    double volume(const SolidParts& parts) const {
        double sum = 0;
        for (const SolidPart& p : parts.parts) {
            const auto at = [&](int k) {
                return p.corners[k] < 0 ? place_of(mesh_, parts.centre) : mesh_.points[p.corners[k]];
            };
            if (p.count == 4)
                sum += signed_volume(at(0), at(1), at(2), at(3));
            else
                sum += signed_volume(at(0), at(1), at(2), at(4)) + signed_volume(at(0), at(2), at(3), at(4));
        }
        return sum;
    }

    Mesh mesh_;
    Index number_ = 1000;
};

TEST_F(SolidPartsOf, ACubeAreSixTetrahedraAroundADiagonal) {
    const SolidParts parts = cut(checks::bricks(1, 1, 1), CellType::hexahedron);
    EXPECT_EQ(parts.parts.size(), 6u);
    EXPECT_TRUE(parts.centre.empty());
    EXPECT_NEAR(volume(parts), 1, 1e-14);
    EXPECT_NEAR(parts.quality, 0.7559, 1e-3);
}

TEST_F(SolidPartsOf, AHexahedronWhoseFacesAreCutAnyWay) {
    // Numbers that turn the diagonals, so that no corner sees all.
    Mesh mesh = checks::bricks(1, 1, 1);
    const Index numbers[8] = {8, 1, 2, 7, 3, 6, 5, 4};
    for (int k = 0; k < 8; ++k) mesh.node_ids[static_cast<std::size_t>(k)] = numbers[k];
    const SolidParts parts = cut(std::move(mesh), CellType::hexahedron);
    EXPECT_NEAR(volume(parts), 1, 1e-14);
    EXPECT_GT(parts.quality, 0.5);
}

TEST_F(SolidPartsOf, APyramidStandsOnAFaceThatStays) {
    const SolidParts parts = cut(checks::bricks(1, 1, 1), CellType::hexahedron, true);
    EXPECT_EQ(std::ranges::count(parts.parts, 5, &SolidPart::count), 1);
    EXPECT_NEAR(volume(parts), 1, 1e-14);
    EXPECT_GT(parts.quality, 0.5);
    const auto& c = std::ranges::find(parts.parts, 5, &SolidPart::count)->corners;
    const auto n = mesh_.block(CellType::hexahedron).nodes(0);
    EXPECT_EQ(quad_key({c[0], c[1], c[2], c[3]}), quad_key({n[0], n[1], n[2], n[3]}));
}

TEST_F(SolidPartsOf, PrismsPyramidsAndDegenerateHexahedra) {
    Mesh prism, pyramid, degenerate = checks::bricks(1, 1, 1);
    for (int k = 0; k < 6; ++k) prism.add_node(ShapeBlend::corner(CellType::wedge, k), k + 1);
    prism.add_cell(CellType::wedge, std::array<Index, 6>{0, 1, 2, 3, 4, 5}, 1);
    SolidParts parts = cut(std::move(prism), CellType::wedge);
    EXPECT_EQ(parts.parts.size(), 3u);
    EXPECT_NEAR(volume(parts), 1, 1e-14);
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, 1)})
        pyramid.add_node(x, pyramid.node_count() + 1);
    pyramid.add_cell(CellType::pyramid, std::array<Index, 5>{0, 1, 2, 3, 4}, 1);
    parts = cut(std::move(pyramid), CellType::pyramid);
    EXPECT_EQ(parts.parts.size(), 2u);
    EXPECT_NEAR(volume(parts), 1.0 / 3, 1e-14);
    auto& n = degenerate.block(CellType::hexahedron).connectivity;
    n[6] = n[5];  // a prism on its side
    n[7] = n[4];
    parts = cut(std::move(degenerate), CellType::hexahedron);
    EXPECT_EQ(parts.parts.size(), 3u);
    EXPECT_NEAR(volume(parts), 0.5, 1e-14);
    EXPECT_GT(parts.quality, 0.5);
}

TEST_F(SolidPartsOf, MiddlesFollowBentEdges) {
    Mesh mesh = to_second_order(checks::bricks(1, 1, 1));
    // A shell of a fifth of its size in thickness, bent by half of that.
    const auto bent = [](const Vec3& x) { return Vec3(x[0], x[1], 0.2 * x[2] + 0.4 * x[0] * (1 - x[0])); };
    for (Vec3& x : mesh.points) x = bent(x);
    const SolidParts parts = cut(std::move(mesh), CellType::hexahedron20);
    EXPECT_GT(parts.quality, 0.1);
    EXPECT_FALSE(parts.middles.empty());
    for (const auto& [edge, at] : parts.middles) {
        const Vec3 x = place_of(mesh_, at);
        EXPECT_NEAR(x[2], bent({x[0], x[1], (x[2] - 0.4 * x[0] * (1 - x[0])) / 0.2})[2], 1e-14);
        EXPECT_NEAR((x[2] - 0.4 * x[0] * (1 - x[0])) / 0.2, 0.5, 0.26);
    }
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
