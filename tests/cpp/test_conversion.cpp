// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/quad_table.h"
#include "mesh/order.h"
#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::bricks;
using checks::number_near;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::int8_t> level_at(const Mesh& mesh, const Vec3& at) {
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    level[static_cast<std::size_t>(number_near(mesh, at))] = 0;
    return level;
}

const std::vector<Index>& hexahedra(const Conversion& c) { return c.cells[static_cast<int>(CellType::hexahedron)]; }

std::vector<QuadKey> keys(const QuadTable<char>& table) {
    std::vector<QuadKey> out;
    table.for_each([&](const QuadKey& key, char) { out.push_back(key); });
    std::ranges::sort(out);
    return out;
}

TEST(QuadTable, FindsWhatWasPutIntoIt) {
    QuadTable<Index> table;
    EXPECT_TRUE(table.empty());
    EXPECT_EQ(table.find({1, 2, 3, 4}), nullptr);
    for (Index k = 0; k < 1000; ++k) EXPECT_TRUE(table.emplace(quad_key({k + 3, k, k + 2, k + 1}), k).second);
    EXPECT_FALSE(table.emplace(quad_key({0, 1, 2, 3}), 7).second);
    for (Index k = 0; k < 1000; ++k) {
        const Index* found = table.find(quad_key({k, k + 1, k + 2, k + 3}));
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, k);
    }
    EXPECT_FALSE(table.contains(quad_key({0, 1, 2, 4})));
    Index sum = 0;
    table.for_each([&](const QuadKey&, Index k) { sum += k; });
    EXPECT_EQ(sum, 999 * 1000 / 2);
}

TEST(Conversion, TakesTheElementsThereAndThoseAcrossTheirFaces) {
    const Mesh mesh = bricks(5, 1, 1);
    const Conversion there = plan_conversion(mesh, level_at(mesh, {0, 0, 0}), nullptr);
    EXPECT_THAT(hexahedra(there), ElementsAre(0, 1));
    const std::vector<QuadKey> bases = keys(there.bases);
    ASSERT_EQ(bases.size(), 1u);
    for (const Index n : bases[0]) EXPECT_EQ(mesh.points[n].x(), 2);
    const Adjacency adjacency(mesh);
    const Conversion same = plan_conversion(mesh, level_at(mesh, {0, 0, 0}), &adjacency);
    EXPECT_EQ(same.cells, there.cells);
    EXPECT_EQ(keys(same.bases), bases);
    EXPECT_TRUE(plan_conversion(mesh, std::vector<std::int8_t>(mesh.points.size(), -1), nullptr).empty());
}

TEST(Conversion, GoesThroughFacesWithMiddles) {
    Mesh mesh;
    for (int k = 0; k < 4 * 3 * 3 + 20; ++k) mesh.add_node(Vec3(k, 0, 0), k + 1);
    // Two elements of 27 nodes and one of 8 in a row; that they are in one place does not matter.
    std::array<Index, 27> a{}, b{};
    for (int k = 0; k < 27; ++k) a[k] = k, b[k] = k + 20;
    for (int k = 0; k < 4; ++k) b[k] = a[4 + k];
    mesh.add_cell(CellType::hexahedron27, a, 1);
    mesh.add_cell(CellType::hexahedron27, b, 2);
    std::vector<std::int8_t> level(mesh.points.size(), -1);
    level[0] = 0;
    const Conversion all = plan_conversion(mesh, level, nullptr);
    EXPECT_THAT(all.cells[static_cast<int>(CellType::hexahedron27)], ElementsAre(0, 1));
    EXPECT_TRUE(all.bases.empty());
}

TEST(Conversion, TakesShellsOnWhatIsCut) {
    Mesh mesh = bricks(5, 1, 1);
    for (const int x : {1, 3}) {  // on the skin of the second and of the fourth
        const auto at = [&](double dx, double y) { return number_near(mesh, {x + dx, y, 0}); };
        mesh.add_cell(CellType::quad, std::array<Index, 4>{at(0, 0), at(1, 0), at(1, 1), at(0, 1)}, 20 + x);
    }
    const Conversion there = plan_conversion(mesh, level_at(mesh, {0, 0, 0}), nullptr);
    EXPECT_THAT(there.cells[static_cast<int>(CellType::quad)], ElementsAre(0));
}

TEST(ElementFaces, OfDegenerateElementsAreWhatIsLeft) {
    Mesh mesh = bricks(1, 1, 1);
    CellBlock& block = mesh.block(CellType::hexahedron);
    EXPECT_EQ(faces_of(mesh, {CellType::hexahedron, 0}).size(), 6u);
    for (int k = 5; k < 8; ++k) block.connectivity[static_cast<std::size_t>(k)] = block.connectivity[4];
    const std::vector<ElementFace> faces = faces_of(mesh, {CellType::hexahedron, 0});
    ASSERT_EQ(faces.size(), 5u);
    EXPECT_EQ(std::ranges::count(faces, 4, &ElementFace::count), 1);
    EXPECT_EQ(faces[1].number, 3);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
