// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

namespace femscalpel {

/// Whether a file that is called so is to be gzip'd: whether its name ends in ".gz", case ignored.
bool is_packed(const std::filesystem::path& path);

/// The bytes of a file, unpacked if it is gzip'd, whatever its name (text: load_text(), plain_text.h). Throws ReadError
/// that names the file, and Cancelled.
std::string load_bytes(const std::filesystem::path& path);

/// Writes a text file by way of AtomicFile, gzip'd if is_packed(path). Throws WriteError that names the file, and
/// Cancelled.
void save_text(const std::filesystem::path& path, const std::string& text);

}  // namespace femscalpel
