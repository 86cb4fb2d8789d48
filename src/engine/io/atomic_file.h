// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string_view>

namespace femscalpel {

/// A file that appears complete or not at all. A writer fills temporary(), closes it, then calls
/// commit(), which renames it to the target; a target that was there before stays whole until that
/// moment. Without commit(), as when an exception passes, the temporary file is removed.
///
/// A target that is a symbolic link is followed; an existing target's permissions are kept. This guards
/// against errors and full disks, not against a power cut: nothing forces the data to the medium.
class AtomicFile {
public:
    /// Makes an empty temporary file in the target's directory. Throws WriteError that names the target
    /// and the reason: directory missing or not writable, target write-protected or not a regular file.
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// The file to write to. It exists, empty; a writer may also replace it by another of that name.
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Puts the temporary file in the target's place. Throws WriteError that names the target.
    void commit();

private:
    std::filesystem::path shown_;   // the target as the caller wrote it, for messages
    std::filesystem::path target_;  // the same with links followed
    std::filesystem::path temporary_;
};

/// Writes `text` to `out`, in pieces: a check point (cancel.h) before each.
void write_obeying(std::ostream& out, std::string_view text);

}  // namespace femscalpel
