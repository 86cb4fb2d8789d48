// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "deck/deck_view.h"
#include "deck/rules/card_rule.h"

namespace femscalpel {

/// *MPC: type, nodes, and more of them on lines that start with a number; 0 is none. Its nodes do not move. PLANE and
/// STRAIGHT get new nodes between their nodes, and lose removed ones; other types stay on the originals, and it is told
/// where nodes are born between these.
class Mpcs : public CardRule {
public:
    bool takes(const Card& card) const override { return card.keyword == "MPC"; }
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void mark(std::size_t c, const Card& card, Marking& marking) override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;

private:
    struct Line {
        CardReader line;
        std::vector<NumberOrSet> entries;  ///< after the type
    };
    struct Mpc {
        std::string type;
        std::vector<Line> lines;

        /// All nodes may be listed, and each for itself.
        bool is_list() const { return type == "PLANE" || type == "STRAIGHT"; }
        std::vector<Index> nodes() const;
    };
    static std::vector<Mpc> read(const Card& card);
    static void carry_line(std::size_t c, const Mpc& mpc, const Line& line, Carrying& carrying);
    static void add_new_nodes(std::size_t c, const Mpc& mpc, Carrying& carrying);
    static void tell_not_joining(const Mpc& mpc, Carrying& carrying);
};

}  // namespace femscalpel
