// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/inp_cards.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "cancel.h"
#include "error.h"
#include "io/abaqus_cards.h"
#include "io/flat_lines.h"
#include "io/plain_text.h"
#include "utf8.h"

namespace femscalpel {
namespace {

namespace fs = std::filesystem;

/// See read_cards().
class CardSplitter {
public:
    CardSplitter(const fs::path& deck, std::vector<std::string>& remarks)
        : folder_(deck.parent_path()), remarks_(remarks) {
        cards_.emplace_back();
        read(deck);
        if (cards_.front().text.empty()) cards_.erase(cards_.begin());
    }

    std::vector<Card> take() { return std::move(cards_); }

private:
    void read(const fs::path& path) {
        std::error_code error;
        open_.push_back(fs::weakly_canonical(path, error));
        const std::size_t remarks = remarks_.size();
        const auto file = std::make_shared<const DeckFile>(DeckFile{shown_path(path), load_text(path, remarks_)});
        const bool was_utf8 = remarks_.size() == remarks;
        const char* p = file->text.data();
        const char* const end = p + file->text.size();
        const char* piece = p;
        Index line = 1, piece_line = 1;
        const auto finish_piece = [&](const char* to) {
            if (to > piece)
                cards_.back().text.push_back({file, {piece, static_cast<std::size_t>(to - piece)}, piece_line});
        };
        const auto next_line = [end](const char* from) {
            const void* newline = std::memchr(from, '\n', static_cast<std::size_t>(end - from));
            return newline ? static_cast<const char*>(newline) + 1 : end;
        };
        SparseCheck check(1 << 12);
        while (p < end) {
            check();
            const char* next = next_line(p);
            const char* first = p;
            while (first < next && (*first == ' ' || *first == '\t')) ++first;
            const char* second = first + 1;
            while (second < next && (*second == ' ' || *second == '\t')) ++second;
            if (first == next || *first != '*' || (second < next && *second == '*')) {
                p = next;
                ++line;
                continue;
            }
            finish_piece(p);
            std::string head(p, next);
            Index head_lines = 1;
            const char* head_end = next;
            while (head_end < end && ends_with_comma(head)) {
                const char* more = head_end;  // comments may stand before it
                Index lines = 1;
                for (; more < end && is_comment(more, next_line(more)); ++lines) more = next_line(more);
                if (more == end || !continues(more, next_line(more))) break;
                head.append(more, next_line(more));
                head_end = next_line(more);
                head_lines += lines;
            }
            std::string keyword;
            std::vector<CardParameter> parameters;
            parse_keyword(head, keyword, parameters);
            if (keyword == "INCLUDE") {
                include(file->path + ":" + std::to_string(line) + ": ", keyword, path, was_utf8, parameters);
                piece = head_end;
                piece_line = line + head_lines;
            } else {
                cards_.emplace_back();
                cards_.back().keyword = std::move(keyword);
                cards_.back().parameters = std::move(parameters);
                cards_.back().head = static_cast<std::size_t>(head_end - p);
                piece = p;
                piece_line = line;
                if (has_data_in_file(cards_.back().keyword) && cards_.back().parameter("INPUT")) {
                    finish_piece(head_end);
                    read_data_file(path, was_utf8);
                    piece = head_end;
                    piece_line = line + head_lines;
                }
            }
            p = head_end;
            line += head_lines;
        }
        finish_piece(end);
        open_.pop_back();
    }

    static bool is_comment(const char* from, const char* to) {
        const std::string_view line(from, static_cast<std::size_t>(to - from));
        const std::size_t first = line.find_first_not_of(" \t");
        return first != line.npos && line.substr(first).starts_with("**");
    }

    static bool ends_with_comma(std::string_view s) {
        while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r' || s.back() == '\n'))
            s.remove_suffix(1);
        return s.ends_with(',');
    }

    /// A keyword line that ends in a comma goes on if the next line holds parameters. CalculiX itself
    /// takes the comma for nothing and the line for data, so a line of numbers or set names is data.
    static bool continues(const char* from, const char* to) {
        const std::string_view line(from, static_cast<std::size_t>(to - from));
        const std::size_t first = line.find_first_not_of(" \t");
        if (first == line.npos || line[first] == '*') return false;
        if (line.find('=') != line.npos) return true;
        std::string word;
        std::vector<CardParameter> unused;
        parse_keyword(line, word, unused);
        while (!word.empty() && word.back() == '\n') word.pop_back();
        return word == "GENERATE";
    }

    /// The last card's lines of data stand in a file: now they stand here.
    void read_data_file(const fs::path& from, bool was_utf8) {
        Card& card = cards_.back();
        const std::string where = card.where() + ": ", keyword = card.keyword;
        const std::vector<CardParameter> all = card.parameters;
        std::vector<CardParameter> rest = all;
        std::erase_if(rest, [](const CardParameter& p) { return p.name == "INPUT"; });
        change_parameters(card, std::move(rest));
        include(where, keyword, from, was_utf8, all);
    }

    void include(const std::string& where, const std::string& keyword, const fs::path& from, bool was_utf8,
                 const std::vector<CardParameter>& parameters) {
        std::string name;
        for (const CardParameter& p : parameters)
            if (p.name == "INPUT") name = p.value;
        if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
        if (name.empty()) throw ReadError(where + "*" + keyword + " needs INPUT=file");
        std::string bare = name;
        std::erase(bare, ' ');  // CalculiX reads file names without blanks
        std::vector<std::string> spellings{name, bare};
        if (!was_utf8)  // as it stood in the file first
            for (const std::string& text : {bare, name})
                if (auto bytes = to_windows_1252(text)) spellings.insert(spellings.begin(), std::move(*bytes));
        std::error_code error;
        for (const std::string& spelling : spellings)
            for (const fs::path& base : {from.parent_path(), folder_}) {
                const fs::path path = base / spelling;
                if (!fs::is_regular_file(path, error)) continue;
                if (std::ranges::find(open_, fs::weakly_canonical(path, error)) != open_.end())
                    throw ReadError(where + "'" + name + "' includes itself");
                if (open_.size() > 50) throw ReadError(where + "includes are nested more than 50 deep");
                read(path);
                return;
            }
        throw ReadError(where +
                        (keyword == "INCLUDE"
                             ? "the included file '" + name + "' does not exist"
                             : "the file '" + name + "' with the lines of *" + keyword + " does not exist") +
                        "; put it beside the deck, or leave the card out");
    }

    fs::path folder_;
    std::vector<fs::path> open_;
    std::vector<Card> cards_;
    std::vector<std::string>& remarks_;
};

}  // namespace

std::vector<Card> read_cards(const fs::path& deck, std::vector<std::string>& remarks) {
    return CardSplitter(deck, remarks).take();
}

}  // namespace femscalpel
