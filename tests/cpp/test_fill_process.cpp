// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/fill_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

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

TEST(FillProcess, NetgenWorksInOneThreadWhateverTheEnvironmentSays) {
    // A program that takes the request and answers with what it was told, as a failure's text of one character.
    const std::filesystem::path script =
        std::filesystem::path(testing::TempDir()) / ("femscalpel_echo_threads_" + std::to_string(::getpid()));
    std::ofstream(script) << "#!/bin/sh\nhead -c 32 <&3 >/dev/null\n"
                          << "printf '\\001\\000\\000\\000\\000\\000\\000\\000\\000\\000\\000\\000' >&3\n"
                          << "printf %s \"$NGS_NUM_THREADS\" >&3\n";
    std::filesystem::permissions(script, std::filesystem::perms::owner_all);
    setenv("NGS_NUM_THREADS", "4", 1);
    const FillAnswer answer = run_fill_program(script, fill_protocol::Request{0, 0, 1, 0.3, 0.3}, {}, {}, 60);
    unsetenv("NGS_NUM_THREADS");
    std::filesystem::remove(script);
    EXPECT_EQ(answer.failure, "1");
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
