// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/msh_source.h"

#include <algorithm>

#include "error.h"
#include "io/inp_file.h"
#include "io/plain_text.h"
#include "utf8.h"

namespace femscalpel {
namespace {

constexpr std::size_t longest_shown_word = 40;  // characters of the file in a message

/// What can be shown of a word of a file, which may be anything.
std::string quoted_word(std::string_view word) {
    std::string out = "'";
    for (const char c : word.substr(0, longest_shown_word)) out += c >= ' ' && c < '\x7f' ? c : '?';
    return out + (word.size() > longest_shown_word ? "...'" : "'");
}

/// Whether a file says that the numbers in it are no text: then its names alone are.
bool is_binary_msh(std::string_view text) {
    constexpr std::string_view head = "$MeshFormat", blanks = " \t\r\n";
    if (!text.starts_with(head)) return false;
    const std::size_t version = text.find_first_not_of(blanks, head.size());
    const std::size_t type = text.find_first_not_of(blanks, text.find_first_of(blanks, version));
    return type != text.npos && text[type] == '1';
}

}  // namespace

MshSource::MshSource(const std::filesystem::path& path) : shown_(shown_path(path)), text_(load_bytes(path)) {
    if (is_binary_msh(text_)) {
        const std::size_t start = text_.find("\n$PhysicalNames") + 1, end = text_.find("\n$EndPhysicalNames", start);
        if (start > 0 && end != text_.npos)
            text_.replace(start, end - start,
                          plain_text(text_.substr(start, end - start), shown_ + ": $PhysicalNames", remarks_));
    } else {
        text_ = plain_text(std::move(text_), shown_, remarks_);
    }
    rewind();
}

void MshSource::rewind() {
    at_ = last_ = section_ = text_.data();
    sections_ = nullptr;
    end_ = text_.data() + text_.size();
    name_ = {};
    binary_ = swapped_ = false;
    size_bytes_ = 8;
}

void MshSource::rewind_to_sections() {
    at_ = last_ = section_ = sections_;
    name_ = {};
}

bool MshSource::find_section(std::string_view name) {
    const std::string wanted = "\n$" + std::string(name);
    const std::string_view text(text_);
    for (std::size_t found = text.find(wanted); found != text.npos; found = text.find(wanted, found + 1)) {
        const std::size_t after = found + wanted.size();
        if (after < text.size() && !is_blank(text[after])) continue;
        at_ = text.data() + found + 1;
        next_section();
        return true;
    }
    return false;
}

std::string_view MshSource::rest_of_line() {
    const char* start = at_;
    const auto* stop = static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    if (!stop) stop = end_;
    at_ = stop < end_ ? stop + 1 : end_;
    while (stop > start && is_blank(stop[-1])) --stop;
    return {start, static_cast<std::size_t>(stop - start)};
}

std::string_view MshSource::word() {
    const char* start = token();
    while (at_ < end_ && !is_blank(*at_)) ++at_;
    return {start, static_cast<std::size_t>(at_ - start)};
}

std::string_view MshSource::next_section() {
    name_ = {};
    const char* start = token();
    if (start == end_) return {};
    const std::string_view line = rest_of_line();
    if (line.size() < 2 || line[0] != '$' || std::ranges::any_of(line, is_blank)) {
        at_ = last_ = start;
        fail("expected the start of a section, as $Nodes, not " + quoted_word(line));
    }
    name_ = line.substr(1);
    section_ = at_;
    return name_;
}

void MshSource::end_section() {
    const std::string_view found = word();
    if (found.size() == name_.size() + 4 && found.starts_with("$End") && found.substr(4) == name_) {
        name_ = {};
        if (!sections_) sections_ = at_;
        return;
    }
    fail("expected $End" + std::string(name_) + ", not " +
         (found.empty() ? "the end of the file" : quoted_word(found)));
}

std::string_view MshSource::content() const {
    const std::string_view rest(section_, static_cast<std::size_t>(end_ - section_));
    return rest.substr(0, rest.find("$End" + std::string(name_)));
}

void MshSource::skip_section() {
    const std::string_view passed = content();
    if (passed.data() + passed.size() == end_) {
        last_ = section_;
        throw ReadError(shown_ + ":" + std::to_string(section_line()) + ": the section $" + std::string(name_) +
                        " does not end; the file is truncated or damaged");
    }
    at_ = passed.data() + passed.size();
    end_section();
}

Index MshSource::section_line() const { return std::count(text_.data(), section_, '\n'); }

double MshSource::text_real() {
    const char* p = token();
    double value = 0;
    const auto [q, error] = std::from_chars(p + (p < end_ && *p == '+' ? 1 : 0), end_, value);
    if (error == std::errc::result_out_of_range) {
        const std::string_view written(p, static_cast<std::size_t>(q - p));
        if (written.find("e-") == written.npos && written.find("E-") == written.npos) fail("a number is too large");
        value = 0;  // too small for a double
    } else if (error != std::errc()) {
        not_a_number("number");
    }
    if (q < end_ && !is_blank(*q)) not_a_number("number");
    at_ = q;
    return value;
}

void MshSource::expect(Index count, Index numbers) const {
    if (count < 0) fail("the number " + std::to_string(count) + " is no count");
    const Index bytes = numbers * (binary_ ? 4 : 2);  // at least
    if (bytes > 0 && count > (end_ - at_) / bytes + 1)
        fail("the number " + std::to_string(count) + " is more than the rest of the file can hold");
}

void MshSource::not_a_number(const char* wanted) const {
    const char* stop = std::find_if(last_, end_, is_blank);
    const std::string_view found(last_, static_cast<std::size_t>(stop - last_));
    if (found.empty()) fail("the file ends within the section $" + std::string(name_));
    if (found.starts_with('$'))
        fail("the section $" + std::string(name_) + " has fewer numbers than it says; it ends with " +
             quoted_word(found));
    fail("expected a " + std::string(wanted) + ", not " + quoted_word(found));
}

std::string MshSource::where() const {
    if (binary_ && !name_.empty())
        return shown_ + ": $" + std::string(name_) + ", byte " + std::to_string(last_ - text_.data()) + ": ";
    return shown_ + ":" + std::to_string(1 + std::count(text_.data(), last_, '\n')) + ": ";
}

void MshSource::fail(const std::string& what) const { throw ReadError(where() + what); }

}  // namespace femscalpel
