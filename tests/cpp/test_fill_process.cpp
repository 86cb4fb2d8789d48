// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/fill_process.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "cutting/fill_protocol.h"
#include "voxel_skin.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

TEST(FillProcess, ProgramIsThere) { EXPECT_TRUE(std::filesystem::exists(fill_program())); }

TEST(FillProcess, SaysWhyNetgenGivesUp) {
    // An open surface, which fill_cavity() would not pass on.
    checks::VoxelSkin skin = checks::voxel_skin(1, 1, 1, [](int, int, int) { return true; });
    skin.triangles.pop_back();
    const fill_protocol::Request request{8, 11, 1e6, 0.3, 0.3};
    const FillAnswer answer = run_fill_program(fill_program(), request, skin.points, skin.triangles, 60);
    EXPECT_NE(answer.failure, "");
    EXPECT_TRUE(answer.tetras.empty());
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
