// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <utility>
#include <vector>

#include "deck/rules/card_rule.h"

namespace femscalpel {

/// *NORMAL: element, node, direction. The node does not move; every part of the element that has the node or a copy of
/// it gets the normal there. New nodes of beams, which have no shape to get one from, get one between those of the
/// ends.
class Normals : public CardRule {
public:
    bool takes(const Card& card) const override { return card.keyword == "NORMAL"; }
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void mark(std::size_t c, const Card& card, Marking& marking) override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

private:
    struct Line {
        CardReader line;
        Index element, node;
    };
    static std::vector<Line> read(const Card& card);
    static std::vector<std::pair<Index, Index>> images(const Line& line, const Carrying& carrying);
    static void add_between(std::size_t c, const std::vector<Line>& lines, Carrying& carrying);
};

}  // namespace femscalpel
