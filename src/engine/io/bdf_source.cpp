// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/bdf_source.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cancel.h"
#include "error.h"
#include "io/plain_text.h"
#include "utf8.h"

namespace femscalpel {
namespace {

constexpr std::size_t small_bdf_width = 8, large_bdf_width = 16;

std::string_view bdf_trim(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n\f\v";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string bdf_capitals(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return out;
}

std::string shown_bdf_field(std::string_view field) {
    constexpr std::size_t longest = 24;
    std::string out = "'";
    for (const char c : field.substr(0, longest)) out += c >= ' ' && c < '\x7f' ? c : '?';
    return out + (field.size() > longest ? "...'" : "'");
}

std::string_view without_bdf_comment(std::string_view line) { return line.substr(0, line.find('$')); }

}  // namespace

std::optional<double> bdf_real(std::string_view text) {
    std::string plain;
    for (const char c : text) {
        const char last = plain.empty() ? '\0' : plain.back();
        if (c == 'd' || c == 'D' || c == 'E')
            plain += 'e';
        else if ((c == '+' || c == '-') && last != '\0' && last != 'e')
            plain += std::string("e") + c;
        else
            plain += c;
    }
    // from_chars() knows no plus sign.
    std::erase(plain, '+');
    double value = 0;
    const char* end = plain.data() + plain.size();
    const auto [stop, error] = std::from_chars(plain.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value) || plain.find_first_of("nN") != plain.npos)
        return {};
    return value;
}

BdfSource::BdfSource(const std::filesystem::path& path) : shown_(shown_path(path)), text_(load_text(path, remarks_)) {
    if (text_.find('\t') != text_.npos) expand_tabs();
    at_ = text_.data();
    end_ = text_.data() + text_.size();
    find_parts();
}

void BdfSource::expand_tabs() {
    std::string out;
    out.reserve(text_.size() * 2);
    std::size_t column = 0;
    for (const char c : text_) {
        if (c == '\t') {
            const std::size_t blanks = small_bdf_width - column % small_bdf_width;
            out.append(blanks, ' ');
            column += blanks;
            continue;
        }
        out += c;
        column = c == '\n' ? 0 : column + 1;
    }
    text_ = std::move(out);
}

std::string_view BdfSource::line_at(const char* at) const {
    return {at, static_cast<std::size_t>(std::find(at, end_, '\n') - at)};
}

std::string BdfSource::where(const char* at) const {
    return shown_ + ":" + std::to_string(1 + std::count(text_.data(), at, '\n')) + ": ";
}

void BdfSource::fail(const char* at, const std::string& what) const { throw ReadError(where(at) + what); }

void BdfSource::find_parts() {
    const char* bulk = nullptr;
    SparseCheck check(1 << 14);
    std::vector<BdfStatement> before;
    for (const char* at = at_; at < end_; check()) {
        const std::string_view line = line_at(at);
        if (line.starts_with('$')) {
            comments_.push_back(bdf_trim(line));
        } else if (const std::string_view text = bdf_trim(without_bdf_comment(line)); !text.empty() && !bulk) {
            std::string statement = bdf_capitals(text);
            if (statement.starts_with("BEGIN"))
                bulk = std::min(end_, line.data() + line.size() + 1);
            else if (!before.empty() && before.back().text.ends_with(','))
                before.back().text += " " + statement;
            else
                before.push_back({std::move(statement), at});
        }
        at = std::min(end_, line.data() + line.size() + 1);
    }
    if (!bulk) {
        if (before.empty()) throw ReadError(shown_ + ": this is no Nastran deck: there are no cards in it");
        return;  // bulk data alone
    }
    statements_ = std::move(before);
    at_ = bulk;
}

bool BdfSource::next(BdfCard& card) {
    card.fields.clear();
    card.at = nullptr;
    while (at_ < end_) {
        const std::string_view whole = line_at(at_);
        const std::string_view line = without_bdf_comment(whole);
        const bool blank = bdf_trim(line).empty();
        const bool goes_on =
            !blank && (line[0] == '+' || line[0] == '*' || line[0] == ',' ||
                       (line[0] == ' ' && bdf_trim(line.substr(0, std::min(line.find(','), small_bdf_width))).empty()));
        if (card.at && !blank && !goes_on) break;
        if (goes_on && !card.at)
            fail(at_,
                 "this line goes on with a card, but there is none before it: continuation lines have to follow "
                 "their card; have the deck written in this order");
        if (!blank) {
            if (!card.at) card.at = at_;
            add_line(line, card);
        }
        at_ = std::min(end_, whole.data() + whole.size() + 1);
    }
    if (!card.at) return false;
    while (!card.fields.empty() && card.fields.back().empty()) card.fields.pop_back();
    if (card.name == "ENDDATA") {
        at_ = end_;
        return false;
    }
    if (card.name == "INCLUDE") fail(card.at, "INCLUDE is not followed: put the file's lines in its place");
    if (card.name == "BEGIN")
        fail(card.at, "this deck has several parts of bulk data (superelements), which are not read; export one");
    return true;
}

void BdfSource::add_line(std::string_view line, BdfCard& card) const {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    const bool first = card.at == line.data();
    if (line.find(',') != line.npos)
        add_free(line, first, card);
    else
        add_columns(line, first, card);
}

void BdfSource::add_free(std::string_view line, bool first, BdfCard& card) const {
    std::vector<std::string_view> words;
    for (std::size_t from = 0;;) {
        const std::size_t comma = line.find(',', from);
        words.push_back(bdf_trim(line.substr(from, comma == line.npos ? comma : comma - from)));
        if (comma == line.npos) break;
        from = comma + 1;
    }
    const bool large = words[0].find('*') != words[0].npos;
    if (first) card.name = bdf_capitals(bdf_trim(words[0].substr(0, words[0].find('*'))));
    const std::size_t count = large ? 4 : 8;
    if (words.size() > count + 2 && std::any_of(words.begin() + static_cast<std::ptrdiff_t>(count) + 2, words.end(),
                                                [](std::string_view w) { return !w.empty(); }))
        fail(line.data(), "this line has more than " + std::to_string(count) + " fields and a mark");
    for (std::size_t k = 1; k <= count; ++k) card.fields.push_back(k < words.size() ? words[k] : std::string_view());
}

void BdfSource::add_columns(std::string_view line, bool first, BdfCard& card) const {
    const std::string_view head = line.substr(0, small_bdf_width);
    const bool large = head.find('*') != head.npos;
    if (first) {
        card.name = bdf_capitals(bdf_trim(head.substr(0, head.find('*'))));
        const bool is_name = !card.name.empty() && card.name[0] >= 'A' && card.name[0] <= 'Z';
        if (!is_name) fail(line.data(), "expected a card, not " + shown_bdf_field(head));
    } else {
        // Where both lines have a mark, it is the same.
        const std::string mark(bdf_trim(head.substr(1)));
        if (!mark.empty() && !mark_.empty() && mark != mark_)
            fail(line.data(), "this line goes on with the card of mark '" + mark_ + "', but its own is '" + mark +
                                  "': continuation lines have to follow their card");
    }
    const std::size_t width = large ? large_bdf_width : small_bdf_width, count = large ? 4 : 8;
    const auto cut = [&](std::size_t from, std::size_t size) {
        return from < line.size() ? bdf_trim(line.substr(from, size)) : std::string_view();
    };
    for (std::size_t k = 0; k < count; ++k) card.fields.push_back(cut(small_bdf_width + k * width, width));
    const std::string_view tail = cut(small_bdf_width + count * width, small_bdf_width);
    mark_ = tail.empty() ? "" : std::string(bdf_trim(tail.substr(tail[0] == '+' || tail[0] == '*')));
}

Index BdfSource::integer(const BdfCard& card, std::size_t field, const char* what) const {
    std::string_view text = card.field(field);
    if (text.empty()) fail(card.at, card.name + " lacks " + what + " (field " + std::to_string(field + 2) + ")");
    if (text.starts_with('+')) text.remove_prefix(1);
    Index value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size())
        fail(card.at, card.name + ": " + what + " (field " + std::to_string(field + 2) + ") is " +
                          shown_bdf_field(text) + ", not a whole number");
    return value;
}

Index BdfSource::integer(const BdfCard& card, std::size_t field, const char* what, Index otherwise) const {
    return card.field(field).empty() ? otherwise : integer(card, field, what);
}

double BdfSource::real(const BdfCard& card, std::size_t field, const char* what) const {
    const std::string_view text = card.field(field);
    if (text.empty()) return 0;
    const std::optional<double> value = bdf_real(text);
    if (!value)
        fail(card.at, card.name + ": " + what + " (field " + std::to_string(field + 2) + ") is " +
                          shown_bdf_field(text) + ", not a number");
    return *value;
}

}  // namespace femscalpel
