// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/flat_lines.h"

#include <algorithm>
#include <memory>

#include "cancel.h"

namespace femscalpel {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }

void split_fields(std::string_view line, std::vector<std::string_view>& out) {
    out.clear();
    while (true) {
        const std::size_t comma = line.find(',');
        out.push_back(line.substr(0, comma));
        if (comma == line.npos) return;
        line.remove_prefix(comma + 1);
    }
}

/// The line with its new fields; a comma at its end stays there.
void append_line(std::string& out, const LineFields& line) {
    const std::size_t given = line.fields.size();
    const bool ends_with_comma = given > 1 && line.fields.back().find_first_not_of(" \t\r") == std::string_view::npos;
    const std::size_t old = ends_with_comma && line.with.size() >= given ? given - 1 : given;
    for (std::size_t k = 0; k < std::max(old, line.with.size()); ++k) {
        if (k > 0) out += ',';
        const bool is_new = k < line.with.size() && line.with[k];
        if (k < old) {
            const std::string_view field = line.fields[k];
            const auto blanks = std::ranges::find_if_not(field, is_blank) - field.begin();
            out += is_new ? field.substr(0, static_cast<std::size_t>(blanks)) : field;
        } else {
            out += ' ';
        }
        if (is_new) out += *line.with[k];
    }
    if (old < given && line.with.size() >= given) out += ',';
}

/// Goes through the lines of one piece of a card's text.
class PieceWriter {
public:
    PieceWriter(const DeckText& piece, const ChangeLine& change, std::size_t& number)
        : piece_(piece), change_(change), number_(number) {}

    /// The piece with its lines changed; the same one if none does.
    DeckText run() {
        const std::string_view text = piece_.text;
        std::string out;
        std::size_t copied = 0;
        Index line_number = piece_.line;
        const auto where = [&] { return piece_.where(line_number) + ": "; };
        for (std::size_t at = 0; at < text.size(); ++line_number) {
            check_();
            const std::size_t newline = text.find('\n', at);
            const std::size_t next = newline == text.npos ? text.size() : newline + 1;
            std::size_t end = newline == text.npos ? text.size() : newline;
            if (end > at && text[end - 1] == '\r') --end;
            const std::string_view line = text.substr(at, end - at);
            const std::size_t first = line.find_first_not_of(" \t");
            if (first != line.npos && line[first] != '*') {
                split_fields(line, fields_.fields);
                fields_.with.clear();
                change_(fields_, number_++, where);
                if (!fields_.with.empty()) {
                    out += text.substr(copied, at - copied);
                    append_line(out, fields_);
                    copied = end;
                }
            }
            at = next;
        }
        if (copied == 0) return piece_;
        out += text.substr(copied);
        const auto file =
            std::make_shared<const DeckFile>(DeckFile{piece_.file->path, std::move(out), piece_.file->carried});
        return {file, file->text, piece_.line};
    }

private:
    const DeckText& piece_;
    const ChangeLine& change_;
    std::size_t& number_;
    LineFields fields_;
    SparseCheck check_{256};
};

/// Parameters are kept without blanks.
std::string readable(const std::string& parameter) {
    for (const std::string_view words : {"REF NODE", "ROT NODE", "CONSTRAINT NAME"})
        if (deck_key(words) == parameter) return std::string(words);
    return parameter;
}

/// Takes the keyword line off the first piece; false if there is none.
bool detach_head(Card& card) {
    if (card.text.empty() || card.head == 0) return false;
    DeckText rest = card.text.front();
    if (card.head < rest.text.size()) {
        const std::string_view head = rest.text.substr(0, card.head);
        rest.line += std::ranges::count(head, '\n');
        rest.text.remove_prefix(card.head);
        card.text.front().text = head;
        card.text.insert(card.text.begin() + 1, rest);
    }
    return true;
}

}  // namespace

bool LineFields::has(std::size_t k) const {
    return k < fields.size() && fields[k].find_first_not_of(" \t\r") != std::string_view::npos;
}

void LineFields::put(std::size_t k, std::string text) {
    if (with.size() <= k) with.resize(k + 1);
    with[k] = std::move(text);
}

void LineFields::cut(std::size_t count) {
    fields.resize(std::min(count, fields.size()));
    with.resize(std::max<std::size_t>(1, std::min(count, with.size())));
}

void change_lines(Card& card, const ChangeLine& change) {
    const std::size_t first = detach_head(card) ? 1 : 0;
    std::size_t number = 0;
    for (std::size_t p = first; p < card.text.size(); ++p)
        card.text[p] = PieceWriter(card.text[p], change, number).run();
}

void change_parameters(Card& card, std::vector<CardParameter> parameters) {
    detach_head(card);
    DeckText& head = card.text.front();
    const bool has_return = head.text.find('\r') != head.text.npos;
    const std::string eol = has_return ? "\r\n" : "\n";
    std::string text(head.text.substr(0, head.text.find(',')));
    while (!text.empty() && std::string_view(" \t\r\n").find(text.back()) != std::string_view::npos) text.pop_back();
    for (const CardParameter& p : parameters) text += ", " + readable(p.name) + (p.value.empty() ? "" : "=" + p.value);
    text += eol;
    for (std::size_t at = head.text.find('\n'); at != head.text.npos && at + 1 < head.text.size();) {
        const std::size_t next = std::min(head.text.find('\n', at + 1), head.text.size() - 1);
        const std::string_view line = head.text.substr(at + 1, next - at);
        const std::size_t first = line.find_first_not_of(" \t");
        text += first != line.npos && line[first] == '*' ? std::string(line) : "**" + eol;
        at = next;
    }
    const auto file = std::make_shared<const DeckFile>(DeckFile{head.file->path, std::move(text), head.file->carried});
    head = {file, file->text, head.line};
    card.head = file->text.size();
    card.parameters = std::move(parameters);
}

std::vector<DeckText> comments_of(const Card& card) {
    Card rest = card;
    detach_head(rest);
    std::vector<DeckText> out;
    for (std::size_t p = card.head > 0 ? 1 : 0; p < rest.text.size(); ++p) {
        const DeckText& piece = rest.text[p];
        Index number = piece.line;
        for (std::size_t at = 0; at < piece.text.size(); ++number) {
            const std::size_t newline = piece.text.find('\n', at);
            const std::size_t next = newline == piece.text.npos ? piece.text.size() : newline + 1;
            const std::string_view line = piece.text.substr(at, next - at);
            const std::size_t first = line.find_first_not_of(" \t\r\n");
            if (first != line.npos && line[first] == '*') out.push_back({piece.file, line, number});
            at = next;
        }
    }
    return out;
}

}  // namespace femscalpel
