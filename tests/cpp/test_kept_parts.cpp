// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/kept_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "groups/band_boundaries.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

struct Found {
    explicit Found(const Mesh& mesh, const ConstraintOptions& options = {})
        : band(extract_band(mesh, std::vector<std::int8_t>(mesh.points.size(), 0))),
          parts(find_kept_parts(band, BandBoundaries(band, mesh), options)) {}

    /// Number of surfaces.
    std::size_t surfaces() {
        std::set<int> roots;
        for (int f = 0; f < static_cast<int>(parts.faces.size()); ++f) roots.insert(parts.joined.find(f));
        return roots.size();
    }

    BandMesh band;
    KeptParts parts;
};

TEST(KeptParts, AreTheSidesAndEdgesOfACube) {
    Found cube(checks::grid(2, 2, 2));
    EXPECT_EQ(cube.parts.faces.size(), 48u);
    EXPECT_EQ(cube.surfaces(), 6u);
    EXPECT_EQ(cube.parts.creases.size(), 24u);
    for (const KeptCrease& c : cube.parts.creases) {
        const Vec3 middle = (cube.band.nodes[c.nodes[0]].at + cube.band.nodes[c.nodes[1]].at) / 2;
        const int on = static_cast<int>(((middle.array() == 0) || (middle.array() == 2)).count());
        EXPECT_EQ(on, 2) << "on two sides of the cube";
        EXPECT_FALSE(c.border);
        EXPECT_FALSE(c.fold);
        EXPECT_EQ(c.groups, 0);
    }
    EXPECT_EQ(cube.parts.match.faces, 0) << "no shape is given";
}

TEST(KeptParts, FollowTheFeatureAngle) {
    ConstraintOptions blunt;
    blunt.feature_angle = 100;
    Found cube(checks::grid(2, 2, 2), blunt);
    EXPECT_EQ(cube.surfaces(), 1u);
    EXPECT_TRUE(cube.parts.creases.empty());
    EXPECT_NEAR(smooth_cosine(blunt), -std::cos(100 * 3.14159265358979 / 180), 1e-12);
}

TEST(KeptParts, PartWhereGroupsMeet) {
    Mesh mesh = checks::grid(2, 1, 1);
    const FamilyIndex left = checks::family_of(mesh, "LEFT", GroupKind::element);
    for (Index c = 0; c < 6; ++c) mesh.block(CellType::tetra).families[c] = left;
    Found bar(mesh);
    // Twenty faces of the skin, two between the cubes; four sides are parted, two ends are not.
    EXPECT_EQ(bar.parts.faces.size(), 22u);
    EXPECT_EQ(std::ranges::count(bar.parts.faces, true, &KeptFace::internal), 2);
    EXPECT_EQ(bar.surfaces(), 4u * 2 + 2 + 1);
    EXPECT_EQ(bar.parts.creases.size(), 16u + 4u) << "edges of the bar, and the border around it";
}

TEST(KeptParts, OfShellsHaveABorder) {
    Mesh mesh;
    checks::add_plate(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2, 2);
    Found plate(mesh);
    EXPECT_EQ(plate.surfaces(), 1u);
    EXPECT_EQ(plate.parts.creases.size(), 8u);
    for (const KeptCrease& c : plate.parts.creases) EXPECT_TRUE(c.border);
    for (const KeptFace& f : plate.parts.faces) EXPECT_TRUE(f.shell);
}

TEST(KeptParts, FoldBackAtTheFrontOfACrack) {
    // The nodes at x = 2, y = 1 are doubled: a crack from there to x = 1.
    Mesh mesh = checks::grid(2, 2, 1);
    std::map<Index, Index> copy;
    for (const double z : {0, 1}) {
        const Index n = checks::number_near(mesh, {2, 1, z});
        copy[n] = mesh.add_node(mesh.points[n], mesh.largest_node_id() + 1);
    }
    CellBlock& tetras = mesh.block(CellType::tetra);
    for (Index c = 0; c < tetras.size(); ++c) {
        double y = 0;
        for (const Index n : tetras.nodes(c)) y += mesh.points[n].y() / 4;
        for (Index k = 4 * c; k < 4 * c + 4; ++k)
            if (const auto it = copy.find(tetras.connectivity[k]); y > 1 && it != copy.end())
                tetras.connectivity[k] = it->second;
    }
    Found cracked(mesh);
    int folds = 0;
    for (const KeptCrease& c : cracked.parts.creases) {
        folds += c.fold;
        for (const int v : c.nodes)
            if (c.fold) {
                EXPECT_EQ(cracked.band.nodes[v].at.x(), 1);
                EXPECT_EQ(cracked.band.nodes[v].at.y(), 1);
            }
    }
    EXPECT_EQ(folds, 1);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
