// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/fill.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <numbers>
#include <random>

#include "cancel.h"
#include "cutting/mend_filling.h"
#include "mesh/quality.h"
#include "voxel_skin.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using checks::voxel_skin;
using checks::VoxelSkin;
using testing::HasSubstr;

bool everywhere(int, int, int) { return true; }

/// Filled, with the checks of fill_cavity() done once more; the smallest mean ratio is printed in test reports.
Filled fill(const VoxelSkin& skin, const FillOptions& options = {}) {
    Filled filled = fill_cavity(skin.points, skin.triangles, options);
    std::vector<Vec3> all = skin.points;
    all.insert(all.end(), filled.points.begin(), filled.points.end());
    EXPECT_EQ(check_filling(all, skin.triangles, filled.tetras), filled.worst);
    testing::Test::RecordProperty("worst", std::to_string(filled.worst));
    testing::Test::RecordProperty("tetras", static_cast<int>(filled.tetras.size()));
    return filled;
}

std::string reason(const VoxelSkin& skin, const FillOptions& options = {}) {
    try {
        fill_cavity(skin.points, skin.triangles, options);
    } catch (const QualityError& e) {
        return e.what();
    }
    return "";
}

TEST(MendFilling, AFlatElementGetsAPointBesideItsPlane) {
    // Two triangles of the skin in a plane, their diagonal the one way; inside, the other way, an element of no height.
    std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-7}, {0, 1, 0}, {0.5, 0.5, -0.7}};
    const std::vector<Triangle> skin{{0, 1, 2}, {0, 2, 3}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};
    std::vector<Tetra> tetras{{0, 1, 3, 4}, {1, 2, 3, 4}, {0, 1, 2, 3}};
    for (Tetra& t : tetras)
        if (signed_volume(points[t[0]], points[t[1]], points[t[2]], points[t[3]]) < 0) std::swap(t[0], t[1]);
    ASSERT_LT(check_filling(points, skin, tetras), 1e-3);
    mend_filling(points, skin, tetras);
    EXPECT_GT(check_filling(points, skin, tetras), 0.2);
    EXPECT_EQ(points.size(), 6u);
    // And what is good stays.
    const std::vector<Tetra> before = tetras;
    mend_filling(points, skin, tetras);
    EXPECT_EQ(tetras, before);
}

TEST(Fill, UnitCube) {
    const Filled filled = fill(voxel_skin(1, 1, 1, everywhere));
    EXPECT_GE(filled.worst, 0.4);
}

TEST(Fill, CubeOf768Triangles) {
    const VoxelSkin skin = voxel_skin(8, 8, 8, everywhere);
    ASSERT_EQ(skin.triangles.size(), 768u);
    EXPECT_GE(fill(skin).worst, 0.4);
}

TEST(Fill, ThinSlab) { EXPECT_GE(fill(voxel_skin(12, 12, 1, everywhere)).worst, 0.3); }

TEST(Fill, LShape) {
    EXPECT_GE(fill(voxel_skin(6, 6, 3, [](int x, int y, int) { return x < 3 || y < 3; })).worst, 0.35);
}

TEST(Fill, Ring) {
    EXPECT_GE(fill(voxel_skin(7, 7, 2, [](int x, int y, int) { return x < 2 || y < 2 || x > 4 || y > 4; })).worst,
              0.35);
}

TEST(Fill, CavityWithAVoid) {
    EXPECT_GE(
        fill(voxel_skin(5, 5, 5,
                        [](int x, int y, int z) { return x == 0 || y == 0 || z == 0 || x > 2 || y > 2 || z > 2; }))
            .worst,
        0.35);
}

TEST(Fill, DisjointCavities) {
    EXPECT_GE(fill(voxel_skin(8, 3, 3, [](int x, int, int) { return x < 3 || x > 4; })).worst, 0.35);
    EXPECT_GE(fill(voxel_skin(9, 9, 9,
                              [](int x, int y, int z) {
                                  const int d = std::max({std::abs(x - 4), std::abs(y - 4), std::abs(z - 4)});
                                  return d == 4 || d < 2;
                              }))
                  .worst,
              0.3)
        << "one in the void of the other";
}

TEST(Fill, CavitiesThatTouchAtAnEdge) {
    EXPECT_GE(fill(voxel_skin(4, 4, 2, [](int x, int y, int) { return (x < 2) == (y < 2); })).worst, 0.3);
}

TEST(Fill, RandomBumps) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> move(-0.3, 0.3);
    for (int k = 0; k < 8; ++k) {
        VoxelSkin skin = voxel_skin(5, 4, 3, everywhere);
        for (Vec3& p : skin.points) p += Vec3(move(random), move(random), move(random));
        EXPECT_GE(fill(skin).worst, 0.1) << k;
    }
}

TEST(Fill, AnyUnitAndPlace) {
    VoxelSkin skin = voxel_skin(3, 3, 3, everywhere);
    for (Vec3& p : skin.points) p = Vec3(1e4, -2e3, 5) + 1e-3 * p;
    EXPECT_GE(fill(skin).worst, 0.3);
}

TEST(Fill, LeavesPointsAloneThatNoTriangleHas) {
    VoxelSkin skin = voxel_skin(2, 2, 2, everywhere);
    skin.points.insert(skin.points.begin(), {Vec3(0.7, 0.8, 0.9), Vec3(9, 9, 9)});
    for (Triangle& t : skin.triangles)
        for (int& v : t) v += 2;
    for (const Tetra& t : fill(skin).tetras)
        for (const int v : t) EXPECT_GE(v, 2);
}

TEST(Fill, EdgesInsideAsLongAsAskedFor) {
    const VoxelSkin skin = voxel_skin(10, 10, 10, everywhere);
    FillOptions fine;
    fine.max_edge = 0.8;
    FillOptions growing;
    growing.grading = 0.9;
    EXPECT_GT(fill(skin, fine).tetras.size(), 2 * fill(skin, growing).tetras.size());
}

TEST(Fill, NamesWhatIsWrongWithTheSurface) {
    VoxelSkin open = voxel_skin(2, 2, 2, everywhere);
    open.triangles.erase(std::ranges::find_if(open.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](int v) { return open.points[v].z() == 2; });
    }));
    EXPECT_THAT(reason(open), HasSubstr("an open edge near ("));

    VoxelSkin inwards = voxel_skin(2, 2, 2, everywhere);
    for (Triangle& t : inwards.triangles) std::swap(t[0], t[1]);
    EXPECT_THAT(reason(inwards), HasSubstr("look inwards"));

    VoxelSkin twice = voxel_skin(1, 1, 1, everywhere);
    twice.triangles.insert(twice.triangles.end(), twice.triangles.begin(), twice.triangles.begin() + 12);
    EXPECT_THAT(reason(twice), HasSubstr("there twice near ("));

    VoxelSkin flat = voxel_skin(1, 1, 1, everywhere);
    flat.points[0] = flat.points[1];
    EXPECT_THAT(reason(flat), HasSubstr("a flat triangle near ("));

    VoxelSkin crossing = voxel_skin(3, 3, 3, everywhere);
    for (Vec3& p : crossing.points)
        if (p == Vec3(1, 1, 3)) p = Vec3(1.2, 1.4, -1.05);
    EXPECT_THAT(reason(crossing), HasSubstr("triangles that cross near ("));

    EXPECT_THAT(reason(VoxelSkin{}), HasSubstr("no triangles"));
}

TEST(Fill, ProgramThatDiesHangsOrIsMissingIsAnError) {
    const VoxelSkin skin = voxel_skin(1, 1, 1, everywhere);
    FillOptions options;
    options.program = "/bin/false";
    EXPECT_THAT(reason(skin, options), HasSubstr("Netgen broke off"));
    EXPECT_THAT(reason(skin, options), HasSubstr("is sharpest near ("));
    options.program = "/no/such/program";
    EXPECT_THROW(fill_cavity(skin.points, skin.triangles, options), Error);
    options = {};
    options.seconds = 0.3;
    EXPECT_THAT(reason(voxel_skin(25, 25, 25, everywhere), options), HasSubstr("no end after"));
}

TEST(Fill, EndsWhenCancelled) {
    const VoxelSkin skin = voxel_skin(25, 25, 25, everywhere);
    const auto start = std::chrono::steady_clock::now();
    const CancelScope scope(CancelToken(),
                            [&] { return std::chrono::steady_clock::now() - start > std::chrono::milliseconds(300); });
    EXPECT_THROW(fill_cavity(skin.points, skin.triangles), Cancelled);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

TEST(Fill, IsSilentInManyThreadsAndGivesTheSameInAll) {
    const VoxelSkin skin = voxel_skin(4, 4, 4, everywhere);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    std::vector<std::future<Filled>> all;
    for (int k = 0; k < 4; ++k)
        all.push_back(std::async(std::launch::async, [&] { return fill_cavity(skin.points, skin.triangles); }));
    const Filled first = all[0].get();
    for (int k = 1; k < 4; ++k) {
        const Filled other = all[k].get();
        EXPECT_EQ(other.points, first.points);
        EXPECT_EQ(other.tetras, first.tetras);
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
