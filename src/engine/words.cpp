// SPDX-License-Identifier: LGPL-2.1-or-later
#include "words.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace femscalpel {
namespace {

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::ranges::transform(out, out.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

/// How many letters must be put in, left out, changed, or swapped with the next, to make one text of the other.
std::size_t edits_between(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            cost[i][j] = std::min(
                {cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    return cost[a.size()][b.size()];
}

}  // namespace

std::string counted(std::int64_t count, std::string_view noun, std::string_view plural) {
    std::string out = std::to_string(count) + " ";
    out += count == 1 || plural.empty() ? noun : plural;
    if (count != 1 && plural.empty()) out += "s";
    return out;
}

std::vector<std::string> similar_names(std::string_view name, std::span<const std::string> names, std::size_t most) {
    constexpr std::size_t shortest_part = 3, longest = 200;
    const std::string wanted = lower_case(name);
    std::vector<std::pair<std::size_t, std::string>> found;
    for (const std::string& candidate : names) {
        const std::string other = lower_case(candidate);
        if (wanted.size() > longest || other.size() > longest) continue;
        const std::size_t edits = edits_between(wanted, other);
        const std::size_t allowed = std::min<std::size_t>(3, wanted.size() / 3 + 1);
        const bool is_part = std::min(wanted.size(), other.size()) >= shortest_part &&
                             (other.find(wanted) != std::string::npos || wanted.find(other) != std::string::npos);
        if ((edits <= allowed && edits < std::max(wanted.size(), other.size())) || is_part)
            found.emplace_back(edits, candidate);
    }
    std::ranges::sort(found);
    const auto repeated = std::ranges::unique(found);
    found.erase(repeated.begin(), repeated.end());
    if (found.size() > most) found.resize(most);
    std::vector<std::string> out;
    out.reserve(found.size());
    for (auto& [edits, candidate] : found) out.push_back(std::move(candidate));
    return out;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> names) {
    const std::vector<std::string> found = similar_names(name, names);
    std::string out;
    for (std::size_t k = 0; k < found.size(); ++k)
        out += (k == 0 ? " Did you mean '" : k + 1 == found.size() ? "' or '" : "', '") + found[k];
    return found.empty() ? out : out + "'?";
}

}  // namespace femscalpel
