// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace femscalpel {

/// What a text file, or the text in one, holds, as all readers of text take it: UTF-8, without a byte-order mark, with
/// lines that end in "\n" or "\r\n". Bytes that are no UTF-8 make the whole text Windows-1252, which is told in
/// `remarks` with the file and the line; "\r" alone ends lines where more do so than not. `shown`: the file, for
/// messages. Throws ReadError for UTF-16 and UTF-32, and Cancelled.
std::string plain_text(std::string bytes, const std::string& shown, std::vector<std::string>& remarks);

/// load_bytes() as plain_text(). Throws as these do.
std::string load_text(const std::filesystem::path& path, std::vector<std::string>& remarks);

}  // namespace femscalpel
