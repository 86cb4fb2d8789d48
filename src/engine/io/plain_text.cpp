// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/plain_text.h"

#include <algorithm>
#include <string_view>

#include "error.h"
#include "io/inp_file.h"
#include "utf8.h"

namespace femscalpel {
namespace {

/// Makes "\r" that stands alone "\n" where that is how lines end, as on a Macintosh of old.
void end_lines(std::string& text) {
    const auto alone = [&](std::size_t at) { return at + 1 == text.size() || text[at + 1] != '\n'; };
    std::size_t first = text.find('\r');
    while (first != text.npos && !alone(first)) first = text.find('\r', first + 1);
    if (first == text.npos) return;
    std::ptrdiff_t count = 0;
    for (std::size_t at = first; at != text.npos; at = text.find('\r', at + 1)) count += alone(at);
    if (count <= std::ranges::count(text, '\n')) return;
    for (std::size_t at = first; at != text.npos; at = text.find('\r', at + 1))
        if (alone(at)) text[at] = '\n';
}

}  // namespace

std::string plain_text(std::string bytes, const std::string& shown, std::vector<std::string>& remarks) {
    using std::string_view_literals::operator""sv;
    for (const std::string_view mark : {"\xFF\xFE"sv, "\xFE\xFF"sv, "\0\0\xFE\xFF"sv})
        if (bytes.starts_with(mark))
            throw ReadError(shown + ": this is text in UTF-16 or UTF-32, which is not read; save it as UTF-8");
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
    end_lines(bytes);
    const std::size_t odd = not_utf8(bytes);
    if (odd == bytes.npos) return bytes;
    const auto line = 1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(odd), '\n');
    remarks.push_back(shown + ":" + std::to_string(line) +
                      ": the text is not UTF-8, here for the first time; it is read as Windows-1252 (Latin-1). Look at "
                      "names with letters beyond A to Z");
    return from_windows_1252(bytes);
}

std::string load_text(const std::filesystem::path& path, std::vector<std::string>& remarks) {
    return plain_text(load_bytes(path), shown_path(path), remarks);
}

}  // namespace femscalpel
