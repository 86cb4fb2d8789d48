// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/unv_source.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "cancel.h"
#include "deck/solver_input.h"
#include "error.h"
#include "io/plain_text.h"
#include "utf8.h"

namespace femscalpel {
namespace {

std::string_view without_end(std::string_view line) {
    while (!line.empty() && (line.back() == ' ' || (line.back() >= '\t' && line.back() <= '\r'))) line.remove_suffix(1);
    return line;
}

std::string_view without_start(std::string_view line) {
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    return line;
}

std::string shown_word(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string out = "'";
    for (const char c : word.substr(0, longest)) out += c >= ' ' && c < '\x7f' ? c : '?';
    return out + (word.size() > longest ? "...'" : "'");
}

}  // namespace

UnvSource::UnvSource(const std::filesystem::path& path) : shown_(shown_path(path)), text_(load_text(path, remarks_)) {
    at_ = last_ = text_.data();
    end_ = text_.data() + text_.size();
    find_datasets();
}

void UnvSource::find_datasets() {
    std::string_view delimiter;  // as the file writes it: "-1" may stand in data, too, but in wider columns
    UnvDataset open;
    const char* start = nullptr;  // of the open data set's content
    const char* opened = nullptr;
    SparseCheck check(1 << 14);
    while (at_ < end_) {
        check();
        last_ = at_;
        const char* line_start = at_;
        const std::string_view line = rest_of_line();
        if (start) {
            if (line != delimiter) continue;
            open.content = {start, static_cast<std::size_t>(line_start - start)};
            datasets_.push_back(open);
            start = nullptr;
            continue;
        }
        if (line.empty()) continue;
        if (delimiter.empty() && without_start(line) == "-1") delimiter = line;
        if (line != delimiter || delimiter.empty()) {
            last_ = line_start;
            fail(datasets_.empty() ? "this is no universal file, which begins with a line of -1"
                                   : "expected a line of -1, which opens a data set, not " + shown_word(line));
        }
        opened = at_;
        const std::string_view number = without_start(rest_of_line());
        open.number = number.substr(0, number.find_first_of(" \t"));
        if (open.number.empty() || open.number[0] < '0' || open.number[0] > '9') {
            last_ = opened;
            fail("expected the number of a data set, not " + shown_word(number));
        }
        start = at_;
    }
    if (start) {
        last_ = opened;
        fail("data set " + std::string(open.number) + " does not end; the file is truncated or damaged");
    }
}

void UnvSource::open(const UnvDataset& dataset) {
    dataset_ = &dataset;
    at_ = last_ = dataset.content.data();
    end_ = at_ + dataset.content.size();
}

std::string_view UnvSource::rest_of_line() {
    const char* start = at_;
    const auto* stop = static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    if (!stop) stop = end_;
    at_ = stop < end_ ? stop + 1 : end_;
    return without_end({start, static_cast<std::size_t>(stop - start)});
}

int UnvSource::words_ahead(int ahead) const {
    const char* p = at_;
    for (; ahead > 0 && p < end_; --ahead) {
        p = std::find(p, end_, '\n');
        if (p < end_) ++p;
    }
    int words = 0;
    while (p < end_ && *p != '\n') {
        if (is_blank(*p)) {
            ++p;
            continue;
        }
        p = end_of_column(p, std::find_if(p, end_, is_blank));
        ++words;
    }
    return words;
}

const char* UnvSource::end_of_column(const char* at, const char* stop) const {
    if (stop - at <= unv_width || !std::all_of(at, stop, [](char c) { return c >= '0' && c <= '9'; })) return stop;
    const char* line = at;
    while (line > text_.data() && line[-1] != '\n') --line;
    if ((stop - line) % unv_width != 0) return stop;
    return line + ((at - line) / unv_width + 1) * unv_width;
}

Index UnvSource::integer_of_columns(const char* what) {
    const char* word_end = std::find_if(at_, end_, is_blank);
    const char* stop = end_of_column(at_, word_end);
    Index value = 0;
    const auto [q, error] = std::from_chars(at_, stop, value);
    if (error != std::errc() || q != stop) not_a_number(what, "whole number");
    at_ = stop;
    return value;
}

double UnvSource::real(const char* what) {
    skip_blanks();
    double value = 0;
    const auto [q, error] = std::from_chars(at_, end_, value);
    if (error == std::errc() && (q == end_ || is_blank(*q)) && std::isfinite(value)) {
        at_ = q;
        return value;
    }
    const char* stop = std::find_if(at_, end_, is_blank);
    const std::string_view word(at_, static_cast<std::size_t>(stop - at_));
    const auto fortran = word.empty() ? std::nullopt : deck_number(word);
    if (!fortran) not_a_number(what, "finite number");
    at_ = stop;
    return *fortran;
}

void UnvSource::not_a_number(const char* what, const char* wanted) const {
    const char* stop = std::find_if(last_, end_, is_blank);
    const std::string set = dataset_ ? "data set " + std::string(dataset_->number) : "the file";
    if (stop == last_) fail(set + " ends where " + what + " should follow");
    fail(std::string(what) + " should be a " + wanted + ", not " +
         shown_word({last_, static_cast<std::size_t>(stop - last_)}));
}

std::string UnvSource::where(const char* at) const {
    return shown_ + ":" + std::to_string(1 + std::count(text_.data(), at ? at : last_, '\n')) + ": ";
}

void UnvSource::fail(const std::string& what, const char* at) const { throw ReadError(where(at) + what); }

}  // namespace femscalpel
