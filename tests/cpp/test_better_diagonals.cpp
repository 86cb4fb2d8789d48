// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/better_diagonals.h"

#include <gtest/gtest.h>

#include "cutting/simplify.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// A sheared prism, each of whose quadrangles is best cut along a diagonal, which together make a sliver.
Mesh sheared_prism() {
    Mesh mesh;
    mesh.points = {{9.4859, 0.8479, 2.2485}, {9.6269, 1.1531, 1.0079}, {9.8793, 2.1313, 0.7544},
                   {10.384, 1.2311, 2.5954}, {10.631, 0.839, 0.4283},  {10.7607, 1.793, 0.7527}};
    mesh.node_ids = {1, 2, 3, 4, 5, 6};
    mesh.node_families.assign(6, 0);
    const std::vector<Index> nodes{0, 1, 2, 3, 4, 5};
    mesh.add_cell(CellType::wedge, nodes, 1, 0);
    return mesh;
}

Conversion of_all() {
    Conversion conversion;
    conversion.cells[static_cast<int>(CellType::wedge)] = {0};
    return conversion;
}

double worst_tetra(const Mesh& mesh) {
    double worst = 1, volume = 0;
    for (Index c = 0; c < mesh.block(CellType::tetra).size(); ++c) {
        worst = std::min(worst, mean_ratio(mesh, CellType::tetra, c));
        volume += cell_measure(mesh, CellType::tetra, c);
    }
    EXPECT_NEAR(volume, 0.8, 0.2);
    return worst;
}

TEST(BetterDiagonals, MakeGoodPartsWhereThoseThatAreBestForEachFaceDoNot) {
    const Mesh mesh = sheared_prism();
    const QuadTable<QuadDiagonal> found = better_diagonals(mesh, of_all(), {{0.04, {CellType::wedge, 0}}});
    EXPECT_FALSE(found.empty());
    const Simplified out = simplify(mesh, of_all(), next_numbers(mesh));
    out.mesh.validate();
    EXPECT_GT(worst_tetra(out.mesh), 0.4);  // 0.04 with those best for each face
}

TEST(BetterDiagonals, LeaveFacesThatPyramidsStandOn) {
    const Mesh mesh = sheared_prism();
    Conversion conversion = of_all();
    const std::array<std::array<Index, 4>, 3> faces{{{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
    for (const auto& f : faces) conversion.bases.emplace(quad_key(f), 1);
    EXPECT_TRUE(better_diagonals(mesh, conversion, {{0.04, {CellType::wedge, 0}}}).empty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
