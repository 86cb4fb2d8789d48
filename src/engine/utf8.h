// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

/// Text is UTF-8 everywhere in the engine, and in all that it hands out: names, messages, warnings. What comes from
/// outside, from files and their names, goes through here.
namespace femscalpel {

/// Where the first byte is that belongs to no character of UTF-8 (RFC 3629: no overlong forms, surrogates, or what lies
/// beyond Unicode); npos in text that is UTF-8. Throws Cancelled.
std::size_t not_utf8(std::string_view text);

/// What Windows-1252 means by these bytes, in UTF-8. That is Latin-1 with quotation marks, dashes and the euro sign
/// where Latin-1 has control characters; the five bytes that mean nothing stay the control characters they are there.
/// Different bytes become different text. Throws Cancelled.
std::string from_windows_1252(std::string_view bytes);

/// The bytes that from_windows_1252() makes this UTF-8 of; nothing if there are none.
std::optional<std::string> to_windows_1252(std::string_view text);

/// A name of a file, or of anything else, as text: as it is if it is UTF-8, else taken for Windows-1252.
std::string as_utf8(std::string name);

/// A path for messages and as a name. What is to be opened is the path itself.
std::string shown_path(const std::filesystem::path& path);

}  // namespace femscalpel
