// SPDX-License-Identifier: LGPL-2.1-or-later
// Faces and edges that pass through elements elsewhere.
#include "cutting/crossing.h"

#include <gtest/gtest.h>

#include "simple_meshes.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

/// A cube of eight, and a triangle of nodes of its own with these corners.
std::optional<CellRef> crossed(const Vec3& a, const Vec3& b, const Vec3& c) {
    Mesh mesh = checks::grid(2, 2, 2);
    std::vector<std::array<Index, 3>> parts{{mesh.add_node(a, 1001), mesh.add_node(b, 1002), mesh.add_node(c, 1003)}};
    return crossed_element(mesh, parts);
}

TEST(Crossing, APartThroughElements) {
    EXPECT_TRUE(crossed({-1, 1.1, 1.2}, {3, 1.3, 1.4}, {3, 1.9, 1}));
    EXPECT_TRUE(crossed({0.2, 0.3, 0.1}, {0.25, 0.3, 0.1}, {0.2, 0.35, 0.1})) << "inside one of them";
}

TEST(Crossing, WhereMeshesMatch) { EXPECT_TRUE(crossed({1.5, 0, 0}, {1.5, 1, 0}, {1.5, 1, 1})); }

TEST(Crossing, TouchingDoesNotCount) {
    EXPECT_FALSE(crossed({2, 0, 0}, {2, 2, 0}, {2, 2, 2})) << "on the skin";
    EXPECT_FALSE(crossed({2, 1, 1}, {3, 1, 1}, {3, 2, 1})) << "with a corner";
    EXPECT_FALSE(crossed({2.1, 0, 0}, {2.1, 2, 0}, {2.1, 2, 2}));
}

TEST(Crossing, PartsOfTheMeshItselfDoNot) {
    const Mesh mesh = checks::grid(2, 2, 2);
    std::vector<std::array<Index, 3>> parts;
    for (Index c = 0; c < mesh.block(CellType::tetra).size(); ++c) {
        const auto n = mesh.block(CellType::tetra).nodes(c);
        parts.push_back({n[0], n[1], n[2]});
    }
    EXPECT_FALSE(crossed_element(mesh, parts));
    EXPECT_FALSE(crossed_element(mesh, {}));
}

TEST(Crossing, EdgesOfShells) {
    Mesh mesh;
    checks::add_plate(mesh, Vec3::Zero(), {1, 0, 0}, {0, 1, 0}, 3, 3);
    const auto with = [&](const Vec3& a, const Vec3& b) {
        Mesh m = mesh;
        const std::vector<std::array<Index, 3>> parts{{m.add_node(a, 1001), m.add_node(b, 1002), -1}};
        return crossed_element(m, parts).has_value();
    };
    EXPECT_TRUE(with({-1, 0.3, 0}, {5, 1.2, 0}));
    EXPECT_TRUE(with({0.4, 0.3, -1}, {0.4, 0.3, 1})) << "across the plate";
    EXPECT_FALSE(with({-1, 0.3, 0}, {-0.1, 1.2, 0}));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
