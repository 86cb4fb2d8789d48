// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace femscalpel {

/// "1 node", "2 nodes". `plural` where that is not the noun with an s, or other words follow it, as in
/// counted(n, "edge that is long", "edges that are long").
std::string counted(std::int64_t count, std::string_view noun, std::string_view plural = {});

/// The names most like one that is not among them, for a message about it: of the same letters in upper or lower case,
/// or a letter or three off (Damerau and Levenshtein's distance), or of which it is a part. At most `most`, the most
/// like first.
std::vector<std::string> similar_names(std::string_view name, std::span<const std::string> names, std::size_t most = 3);

/// " Did you mean 'A' or 'B'?", or nothing if no name is like it.
std::string did_you_mean(std::string_view name, std::span<const std::string> names);

}  // namespace femscalpel
