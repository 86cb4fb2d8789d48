// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ostream>
#include <random>
#include <string>
#include <system_error>

#include "cancel.h"
#include "error.h"
#include "utf8.h"

namespace fs = std::filesystem;

namespace femscalpel {
namespace {

[[noreturn]] void fail(const fs::path& target, const std::string& reason) {
    throw WriteError(shown_path(target) + ": cannot be written: " + reason);
}

/// Where the data must go: the file a link leads to, also when that file does not exist yet.
fs::path follow_links(const fs::path& target) {
    fs::path path = target;
    std::error_code ignored;
    for (int hops = 0; fs::is_symlink(path, ignored); ++hops) {
        if (hops == 40) fail(target, "too many levels of symbolic links");
        const fs::path next = fs::read_symlink(path, ignored);
        if (ignored) break;
        path = next.is_absolute() ? next : path.parent_path() / next;
    }
    return path;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : shown_(target), target_(follow_links(target)) {
    if (!target_.has_filename()) fail(shown_, "the file name is missing");
    const fs::path directory = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    std::error_code error;
    if (!fs::is_directory(directory, error)) fail(shown_, "there is no directory " + shown_path(directory));
    const fs::file_status status = fs::status(target_, error);
    if (fs::exists(status)) {
        if (!fs::is_regular_file(status)) fail(shown_, "it is not a regular file");
        // Renaming would silently replace a file its owner has write-protected.
        std::FILE* probe = std::fopen(target_.c_str(), "r+b");
        if (!probe) fail(shown_, std::strerror(errno));
        std::fclose(probe);
    }

    // The name has a fixed length, so that a target name of the largest length still has a temporary.
    std::random_device random;
    for (int attempt = 0; attempt < 100; ++attempt) {
        char name[40];
        std::snprintf(name, sizeof name, ".femscalpel-%08x%08x.tmp", random(), random());
        temporary_ = directory / name;
        if (std::FILE* file = std::fopen(temporary_.c_str(), "wxb")) {
            std::fclose(file);
            if (fs::exists(status)) fs::permissions(temporary_, status.permissions(), error);
            return;
        }
        if (errno != EEXIST) break;
    }
    const int reason = errno;
    temporary_.clear();
    fail(shown_, std::strerror(reason));
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) fail(shown_, error.message());
    temporary_.clear();
}

void write_obeying(std::ostream& out, std::string_view text) {
    constexpr std::size_t piece = 1 << 22;
    for (; !text.empty(); text.remove_prefix(std::min(piece, text.size()))) {
        check_cancelled();
        out.write(text.data(), static_cast<std::streamsize>(std::min(piece, text.size())));
    }
}

}  // namespace femscalpel
