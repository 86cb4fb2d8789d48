// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace femscalpel {

/// Whether the parts of the file MED-fichier reads a mesh from can be walked and fit its buffers. To be asked before
/// the library reads anything: it copies link names and attributes into buffers of fixed size without looking at their
/// length, so a damaged file could overwrite memory. The caller holds lock_libraries().
bool is_sound_med(const std::string& path);

/// The same of the parts that fields are read from, whose text attributes have at most longest_med_attribute bytes.
bool are_sound_med_fields(const std::string& path);

/// In bytes; names of a field's components are the longest.
inline constexpr std::size_t longest_med_attribute = 65536;

}  // namespace femscalpel
