// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "error.h"

namespace fs = std::filesystem;

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::HasSubstr;

std::string content(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class AtomicFileTest : public testing::Test {
protected:
    void SetUp() override {
        // One directory per test: CTest runs them at the same time.
        directory_ = fs::path(testing::TempDir()) /
                     (std::string("femscalpel_") + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(directory_);
        fs::create_directories(directory_);
    }
    void TearDown() override { fs::remove_all(directory_); }

    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_), fs::directory_iterator{}));
    }

    fs::path directory_;
};

TEST_F(AtomicFileTest, AppearsOnCommitOnly) {
    const fs::path target = directory_ / "a.txt";
    std::ofstream(target) << "old";
    {
        AtomicFile file(target);
        std::ofstream(file.temporary()) << "new";
        EXPECT_EQ(content(target), "old");
        file.commit();
    }
    EXPECT_EQ(content(target), "new");
    EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, LeavesNothingWithoutCommit) {
    const fs::path target = directory_ / "a.txt";
    {
        AtomicFile file(target);
        std::ofstream(file.temporary()) << "half";
        EXPECT_EQ(files(), 1u);
    }
    EXPECT_EQ(files(), 0u);
}

TEST_F(AtomicFileTest, FollowsLinksAndKeepsPermissions) {
    const fs::path real = directory_ / "real.txt", link = directory_ / "link.txt";
    std::ofstream(real) << "old";
    const fs::perms mode = fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read;
    fs::permissions(real, mode);
    fs::create_symlink("real.txt", link);
    AtomicFile file(link);
    std::ofstream(file.temporary()) << "new";
    file.commit();
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(content(real), "new");
    EXPECT_EQ(fs::status(real).permissions(), mode);
}

TEST_F(AtomicFileTest, NamesTheTargetItCannotWrite) {
    const fs::path nowhere = directory_ / "missing" / "a.txt";
    try {
        AtomicFile file(nowhere);
        FAIL();
    } catch (const WriteError& e) {
        EXPECT_THAT(e.what(), HasSubstr(nowhere.string()));
        EXPECT_THAT(e.what(), HasSubstr("no directory"));
    }
    EXPECT_THROW(AtomicFile{directory_}, WriteError);
    EXPECT_THROW(AtomicFile{"/dev/null"}, WriteError);
    EXPECT_THROW(AtomicFile{""}, WriteError);
    EXPECT_THROW(AtomicFile{directory_ / std::string(300, 'x')}.commit(), WriteError);
    EXPECT_EQ(files(), 0u);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
