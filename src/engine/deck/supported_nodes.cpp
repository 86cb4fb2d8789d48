// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/supported_nodes.h"

#include <algorithm>

namespace femscalpel {

SupportedNodes::Line SupportedNodes::read_line(const DeckView& deck, const Numbers& nodes, NumberOrSet what,
                                               CardReader line) {
    Line out{std::move(what), {}, 1, 11};
    if (line.integer(out.first) && (line.at_end() || !line.integer(out.last) || out.last == 0)) out.last = out.first;
    out.last = std::min<Index>(out.last, 11);
    if (out.what.is_number()) {
        if (nodes.contains(out.what.number)) out.nodes.push_back(out.what.number);
    } else if (const auto group = deck.group(DeckSetType::nset, out.what.set)) {
        for (const Index node : nodes)
            if (const auto n = deck.numbers().node(node); n && deck.has_node(*group, *n)) out.nodes.push_back(node);
    }
    return out;
}

SupportedNodes::SupportedNodes(const DeckView& deck, const Numbers& nodes) {
    for (std::size_t c = 0; c < deck.cards().size(); ++c) {
        const Card& card = deck.cards()[c];
        const int step = deck.step(c);
        step_count_ = std::max(step_count_, step);
        if (card.keyword != "BOUNDARY") continue;
        if (const std::string* op = card.parameter("OP"); op && deck_key(*op) == "NEW" && step > 0)
            starts_.insert(step);
        CardReader line(card);
        while (auto what = next_entry(line)) {
            const Line read = read_line(deck, nodes, std::move(*what), line);
            for (const Index node : read.nodes)
                for (Index f = read.first; f <= read.last; ++f) given_[{node, static_cast<int>(f)}].insert(step);
        }
    }
}

std::vector<char> SupportedNodes::steps(Index node, int freedom) const {
    std::vector<char> out(static_cast<std::size_t>(step_count_), 0);
    const auto found = given_.find({node, freedom});
    if (found == given_.end()) return out;
    bool held = found->second.contains(0);
    for (int s = 1; s <= step_count_; ++s) {
        held = (held && !starts_.contains(s)) || found->second.contains(s);
        out[static_cast<std::size_t>(s) - 1] = held;
    }
    return out;
}

bool SupportedNodes::is_always_held(Index node, int freedom) const {
    return is_held(node, freedom) && std::ranges::all_of(steps(node, freedom), [](char held) { return held != 0; });
}

bool SupportedNodes::is_held_with(Index node, Index other, int freedom) const {
    const std::vector<char> mine = steps(node, freedom), its = steps(other, freedom);
    for (std::size_t s = 0; s < mine.size(); ++s)
        if (mine[s] && !its[s]) return false;
    return true;
}

}  // namespace femscalpel
