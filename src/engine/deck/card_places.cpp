// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/card_places.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>

namespace femscalpel {
namespace {

Index count_lines(std::string_view text) {
    return std::ranges::count(text, '\n') + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

/// Where the line behind `count` lines of a text starts.
std::size_t behind_lines(std::string_view text, Index count) {
    std::size_t at = 0;
    for (Index k = 0; k < count && at < text.size(); ++k) {
        const std::size_t end = text.find('\n', at);
        at = end == text.npos ? text.size() : end + 1;
    }
    return at;
}

/// The text of a card in pieces that say where they come from; nothing where it has other lines.
std::vector<DeckText> pieces_at(const Card& card, const std::vector<CardLines>& places) {
    std::string whole;
    for (const DeckText& t : card.text) whole += t.text;
    Index lines = 0;
    for (const CardLines& p : places) lines += p.count;
    if (places.empty() || lines != count_lines(whole)) return {};
    std::vector<DeckText> out;
    std::size_t at = 0;
    for (const CardLines& p : places) {
        if (p.count <= 0) continue;
        const std::size_t size = behind_lines(std::string_view(whole).substr(at), p.count);
        const auto file = std::make_shared<const DeckFile>(DeckFile{p.file, whole.substr(at, size), p.carried});
        out.push_back({file, file->text, p.first});
        at += size;
    }
    return out;
}

}  // namespace

std::vector<std::vector<CardLines>> card_places(const SolverInput& deck) {
    std::vector<std::vector<CardLines>> out;
    std::string folder;
    if (!deck.cards().empty() && !deck.cards().front().text.empty())
        folder = std::filesystem::path(deck.cards().front().text.front().file->path).parent_path().string();
    if (!folder.empty() && folder.back() != '/') folder += '/';
    for (const Card& card : deck.cards()) {
        std::vector<CardLines>& places = out.emplace_back();
        for (const DeckText& t : card.text) {
            const std::string& path = t.file->path;
            places.push_back({t.line, count_lines(t.text),
                              !folder.empty() && path.starts_with(folder) ? path.substr(folder.size()) : path,
                              t.file->carried});
        }
    }
    return out;
}

void set_card_places(SolverInput& deck, const std::vector<std::vector<CardLines>>& places) {
    if (places.size() != deck.cards().size()) return;
    for (std::size_t c = 0; c < places.size(); ++c) {
        Card& card = deck.cards()[c];
        // The keyword line must be in the first piece.
        auto pieces = pieces_at(card, places[c]);
        if (!pieces.empty() && pieces.front().text.size() >= card.head) card.text = std::move(pieces);
    }
}

}  // namespace femscalpel
