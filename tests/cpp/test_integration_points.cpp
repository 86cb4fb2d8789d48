// SPDX-License-Identifier: LGPL-2.1-or-later
// That the points are CalculiX's is tested with CalculiX, in tests/python/test_initial_state.py.
#include "deck/integration_points.h"

#include <gmock/gmock.h>

namespace femscalpel {
namespace FILE_NAMESPACE {

const std::vector<Vec3> cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

Vec3 mean(const std::vector<Vec3>& points) {
    Vec3 out = Vec3::Zero();
    for (const Vec3& x : points) out += x / static_cast<double>(points.size());
    return out;
}

TEST(IntegrationPoints, AreAsManyAsTheTypeHas) {
    const auto count = [](const char* label, CellType type) {
        return integration_points(label, type, std::vector<Vec3>(20, Vec3::Zero())).size();
    };
    EXPECT_EQ(count("C3D4", CellType::tetra), 1u);
    EXPECT_EQ(count("c3d10", CellType::tetra10), 4u);
    EXPECT_EQ(count("C3D6", CellType::wedge), 2u);
    EXPECT_EQ(count("C3D15", CellType::wedge15), 9u);
    EXPECT_EQ(count("C3D8", CellType::hexahedron), 8u);
    EXPECT_EQ(count("C3D8I", CellType::hexahedron), 8u);
    EXPECT_EQ(count("C3D8R", CellType::hexahedron), 1u);
    EXPECT_EQ(count("C3D20", CellType::hexahedron20), 27u);
    EXPECT_EQ(count("C3D20R", CellType::hexahedron20), 8u);
    EXPECT_EQ(count("C3D8", CellType::pyramid), 8u);
    EXPECT_EQ(count("S4", CellType::quad), 0u) << "shells are expanded";
    EXPECT_EQ(count("SC8R", CellType::hexahedron), 0u);
}

TEST(IntegrationPoints, AreInTheElement) {
    const std::vector<Vec3> points = integration_points("C3D8", CellType::hexahedron, cube);
    EXPECT_LT((mean(points) - Vec3::Constant(0.5)).norm(), 1e-15);
    const double low = (1 - std::sqrt(1.0 / 3)) / 2;
    EXPECT_LT((points[0] - Vec3::Constant(low)).norm(), 1e-15);
    EXPECT_LT((points[1] - Vec3(1 - low, low, low)).norm(), 1e-15);
    EXPECT_LT((points[6] - Vec3(low, 1 - low, 1 - low)).norm(), 1e-15);
    const std::vector<Vec3> in_pyramid =
        integration_points("C3D8", CellType::pyramid, std::vector<Vec3>(cube.begin(), cube.begin() + 5));
    EXPECT_LT((in_pyramid[4] - Vec3(low * low, low * low, 1 - low)).norm(), 1e-15) << "above, near the tip over node 1";
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
