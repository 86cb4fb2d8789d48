// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/card_edits.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace femscalpel {

void CardEdits::add(const char* at, std::string_view line) {
    std::string& text = edits_[at].added;
    text += line;
    text += '\n';
}

void CardEdits::append(const Card& card, std::string_view line) {
    if (!last_line_) {
        last_line_ = card.text.front().text.data();
        CardReader reader(card);
        while (reader.next_data_line()) last_line_ = reader.raw().data();
    }
    add(last_line_, line);
}

void CardEdits::apply(Card& card) const {
    std::vector<DeckText> out;
    for (std::size_t p = 0; p < card.text.size(); ++p) {
        const DeckText& piece = card.text[p];
        const char* const end = piece.text.data() + piece.text.size();
        const char* run = piece.text.data();
        const char* line = run;
        Index number = piece.line, run_number = number;
        const auto flush = [&](const char* to) {
            if (to > run) out.push_back({piece.file, {run, static_cast<std::size_t>(to - run)}, run_number});
        };
        while (line < end) {
            // The keyword line and its continuations go together.
            const bool is_head = p == 0 && line == piece.text.data();
            const char* next = is_head ? line + card.head : std::find(line, end, '\n');
            if (!is_head && next < end) ++next;
            const Index next_number = number + std::count(line, next, '\n');
            if (const auto edit = edits_.find(line); edit != edits_.end()) {
                flush(edit->second.drop ? line : next);
                run = next;
                run_number = next_number;
                if (!edit->second.added.empty()) {
                    const std::string place =
                        piece.where(number) + std::string(piece.file->carried ? "" : carried_over);
                    const auto file = std::make_shared<const DeckFile>(DeckFile{place, edit->second.added, true});
                    out.push_back({file, file->text, 1});
                }
            }
            line = next;
            number = next_number;
        }
        flush(end);
    }
    card.text = std::move(out);
}

}  // namespace femscalpel
