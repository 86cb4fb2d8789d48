// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/solver_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

namespace femscalpel {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

const char* skip_blanks(const char* p, const char* end) {
    while (p < end && is_blank(*p)) ++p;
    return p;
}

char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

std::string_view trimmed(std::string_view s) {
    while (!s.empty() && (is_blank(s.front()) || s.front() == '\n')) s.remove_prefix(1);
    while (!s.empty() && (is_blank(s.back()) || s.back() == '\n')) s.remove_suffix(1);
    return s;
}

std::string without_blanks(std::string_view s) {
    std::string out;
    for (char c : s)
        if (!is_blank(c)) out += c;
    return out;
}

/// Numbers the C++ library does not read as they are: 1.d0, +1, 1.5+3, blanks inside.
bool fortran_number(std::string_view field, double& value) {
    std::string s;
    for (char c : field) {
        if (is_blank(c)) continue;
        c = upper(c);
        if (c == 'D' || c == 'Q') c = 'E';
        if ((c == '+' || c == '-') && !s.empty() && s.back() != 'E') s += 'E';
        if (c == '+') continue;
        s += c;
    }
    if (s.empty()) {
        value = 0;
        return true;
    }
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (error == std::errc::result_out_of_range && end == s.data() + s.size()) {
        value = std::strtod(s.c_str(), nullptr);  // too small is 0, too large infinite
        return std::isfinite(value);
    }
    return error == std::errc{} && end == s.data() + s.size() && std::isfinite(value);
}

constexpr std::ptrdiff_t calculix_width = 20;  // CalculiX reads coordinates as (f20.0)

/// Whether CalculiX, which reads 20 characters of a field, gets `value` or nearly so.
bool cut_is_harmless(std::string_view field, double value) {
    const std::string bare = without_blanks(field);
    double cut = 0;
    return bare.size() <= calculix_width ||
           (fortran_number(bare.substr(0, calculix_width), cut) && std::abs(cut - value) <= 1e-12 * std::abs(value));
}

}  // namespace

const SolverInput* solver_input(const Mesh& mesh) { return dynamic_cast<const SolverInput*>(mesh.companion.get()); }

GroupKind group_kind(DeckSetType type) {
    switch (type) {
        case DeckSetType::elset:
            return GroupKind::element;
        case DeckSetType::element_surface:
            return GroupKind::facet;
        default:
            return GroupKind::node;
    }
}

std::string_view to_string(DeckSetType type) {
    switch (type) {
        case DeckSetType::nset:
            return "node set";
        case DeckSetType::elset:
            return "element set";
        case DeckSetType::node_surface:
            return "node surface";
        case DeckSetType::element_surface:
            return "element surface";
    }
    return "";
}

std::string deck_key(std::string_view name) {
    std::string key = without_blanks(name);
    std::ranges::transform(key, key.begin(), upper);
    return key;
}

std::optional<double> deck_number(std::string_view field) {
    double value = 0;
    const std::string_view bare = trimmed(field);
    const auto [end, error] = std::from_chars(bare.data(), bare.data() + bare.size(), value);
    if (error == std::errc{} && end == bare.data() + bare.size() && std::isfinite(value)) return value;
    return fortran_number(bare, value) ? std::optional(value) : std::nullopt;
}

void parse_keyword(std::string_view line, std::string& keyword, std::vector<CardParameter>& parameters) {
    parameters.clear();
    bool first = true;
    while (true) {
        const std::size_t comma = line.find(',');
        const std::string_view part = trimmed(line.substr(0, comma));
        if (first) {
            keyword = deck_key(part.substr(part.starts_with('*') ? 1 : 0));
        } else if (!part.empty()) {
            const std::size_t equals = part.find('=');
            CardParameter p;
            p.name = deck_key(part.substr(0, equals));
            if (equals != part.npos) p.value = trimmed(part.substr(equals + 1));
            parameters.push_back(std::move(p));
        }
        if (comma == line.npos) return;
        first = false;
        line.remove_prefix(comma + 1);
    }
}

const std::string* Card::parameter(std::string_view name) const {
    for (const CardParameter& p : parameters)
        if (p.name == name) return &p.value;
    return nullptr;
}

std::string DeckText::where(Index its_line) const {
    return file->carried ? file->path : file->path + ":" + std::to_string(its_line);
}

std::string Card::where() const {
    if (text.empty()) return "";
    return text.front().where(text.front().line);
}

void Card::set_text(std::string new_text) {
    const auto file =
        std::make_shared<const DeckFile>(DeckFile{text.empty() ? "" : text.front().file->path, std::move(new_text)});
    text = {{file, file->text, text.empty() ? 1 : text.front().line}};
    head = std::min(file->text.find('\n'), file->text.size() - 1) + 1;
    parse_keyword(std::string_view(file->text).substr(0, head), keyword, parameters);
}

Index SolverInput::largest_other_element() const {
    Index largest = kept_element_;
    for (const OtherElement& e : other_elements_) largest = std::max(largest, e.number);
    return largest;
}

std::shared_ptr<const Companion> SolverInput::with_renamed_group(GroupKind kind, const std::string& old_name,
                                                                 const std::string& new_name) const {
    const auto holds = [&](const DeckSet& set) { return group_kind(set.type) == kind && set.group == old_name; };
    if (std::ranges::none_of(sets_, holds)) return nullptr;
    auto renamed = std::make_shared<SolverInput>(*this);
    for (DeckSet& set : renamed->sets_)
        if (holds(set)) set.group = new_name;
    return renamed;
}

bool CardReader::next_line() {
    check_();
    while (piece_ < card_->text.size()) {
        const std::string_view text = card_->text[piece_].text;
        const char* const text_end = text.data() + text.size();
        if (!next_) next_ = text.data() + (piece_ == 0 ? card_->head : 0);
        if (next_ >= text_end) {
            ++piece_;
            next_ = nullptr;
            continue;
        }
        line_ = next_;
        const void* newline = std::memchr(line_, '\n', static_cast<std::size_t>(text_end - line_));
        end_ = newline ? static_cast<const char*>(newline) : text_end;
        next_ = newline ? end_ + 1 : text_end;
        at_ = skip_blanks(line_, end_);
        is_data_ = at_ < end_ && *at_ != '*';
        return true;
    }
    return false;
}

bool CardReader::next_data_line() {
    while (next_line())
        if (is_data_) return true;
    return false;
}

bool CardReader::at_end() {
    at_ = skip_blanks(at_, end_);
    return at_ >= end_;
}

std::string_view CardReader::peek() const {
    const auto* comma = static_cast<const char*>(std::memchr(at_, ',', static_cast<std::size_t>(end_ - at_)));
    return {at_, static_cast<std::size_t>((comma ? comma : end_) - at_)};
}

void CardReader::skip(std::string_view field) { at_ = std::min(field.data() + field.size() + 1, end_); }

bool CardReader::integer(Index& value) {
    const char* p = skip_blanks(at_, end_);
    const auto [q, error] = std::from_chars(p, end_, value);
    if (error == std::errc{}) {
        const char* after = skip_blanks(q, end_);
        if (after == end_ || *after == ',') {
            at_ = std::min(after + 1, end_);
            return true;
        }
    }
    const std::string_view field = peek();
    const std::string bare = without_blanks(field);
    const char* first = bare.data() + (bare.starts_with('+') ? 1 : 0);
    const auto [last, slow_error] = std::from_chars(first, bare.data() + bare.size(), value);
    if (slow_error != std::errc{} || last != bare.data() + bare.size()) return false;
    skip(field);
    return true;
}

bool CardReader::number(double& value) {
    const char* p = skip_blanks(at_, end_);
    const auto [q, error] = std::from_chars(p, end_, value);
    if (error == std::errc{} && std::isfinite(value)) {
        const char* after = skip_blanks(q, end_);
        if (after == end_ || *after == ',') {
            fits_ = q - p <= calculix_width || cut_is_harmless({p, static_cast<std::size_t>(q - p)}, value);
            at_ = std::min(after + 1, end_);
            return true;
        }
    }
    const std::string_view field = peek();
    if (!fortran_number(field, value)) return false;
    fits_ = cut_is_harmless(field, value);
    skip(field);
    return true;
}

std::string CardReader::field() {
    const std::string_view f = peek();
    skip(f);
    return without_blanks(f);
}

bool CardReader::ends_with_comma() const { return trimmed(line()).ends_with(','); }

std::string CardReader::where() const {
    if (piece_ >= card_->text.size()) return card_->where() + ": ";
    const DeckText& piece = card_->text[piece_];
    const Index lines = std::count(piece.text.data(), line_ ? line_ : piece.text.data(), '\n');
    return piece.where(piece.line + lines) + ": ";
}

}  // namespace femscalpel
