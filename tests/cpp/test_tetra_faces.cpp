// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/tetra_faces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "simple_meshes.h"
#include "whole_workpiece.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(TetraFaces, AreFoundOnceEach) {
    const Mesh mesh = checks::grid(1, 1, 1);
    const BandMesh band = extract_band(mesh, std::vector<std::int8_t>(8, 0));
    const TetraFaces all(band, std::vector<char>(8, 1));
    ASSERT_EQ(all.faces.size(), 12u + 6u) << "two on each side, six around the diagonal";
    EXPECT_EQ(std::ranges::count_if(all.faces, &BandBoundaries::Face::is_skin), 12);
    for (std::size_t k = 0; k < all.faces.size(); ++k) {
        const auto& f = all.faces[k];
        const auto& [a, b, c] = f.nodes;
        EXPECT_EQ(all.find({a, b, c}), static_cast<int>(k));
        EXPECT_EQ(all.find({c, a, b}), static_cast<int>(k));
        EXPECT_EQ(all.find({b, a, c}), static_cast<int>(k));
        // The normal points out of the first tetrahedron.
        Vec3 centre = Vec3::Zero();
        for (const int v : band.tetras[f.tetra[0]]) centre += band.nodes[v].at / 4;
        const Vec3 &p = band.nodes[a].at, &q = band.nodes[b].at, &r = band.nodes[c].at;
        EXPECT_GT((q - p).cross(r - p).dot(p - centre), 0);
    }
    EXPECT_EQ(all.find({1, 2, 4}), -1) << "across the cube";
}

TEST(TetraFaces, NeedNodesThatCountAndOneThatMayMove) {
    const Mesh mesh = checks::grid(1, 1, 1);
    BandMesh band = extract_band(mesh, std::vector<std::int8_t>(8, 0));
    std::vector<char> bottom(8, 0);
    for (int v = 0; v < 8; ++v) bottom[v] = band.nodes[v].at.z() == 0;
    EXPECT_EQ(TetraFaces(band, bottom).faces.size(), 2u);
    for (BandNode& n : band.nodes) n.level = n.at == Vec3(1, 0, 0) ? 0 : -1;
    EXPECT_EQ(TetraFaces(band, bottom).faces.size(), 1u);
}

TEST(MarkOuterNodes, FindsTheSkin) {
    const Mesh mesh = checks::grid(2, 2, 2);
    const BandMesh band = extract_band(mesh, std::vector<std::int8_t>(27, 0));
    std::vector<char> marked(27, 0);
    mark_outer_nodes(band, marked);
    for (int v = 0; v < 27; ++v) EXPECT_EQ(marked[v] != 0, band.nodes[v].at != Vec3(1, 1, 1));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
