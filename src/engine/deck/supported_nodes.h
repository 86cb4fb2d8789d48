// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

#include "deck/deck_view.h"

namespace femscalpel {

/// The degrees of freedom that the *BOUNDARY cards of a deck set, of some nodes, by step.
class SupportedNodes {
public:
    using Numbers = std::unordered_set<Index>;

    /// A line of a *BOUNDARY card.
    struct Line {
        NumberOrSet what;
        std::vector<Index> nodes;  ///< those of the nodes looked at that it names
        Index first = 1, last = 1;
    };

    /// Looks at `nodes` alone.
    SupportedNodes(const DeckView& deck, const Numbers& nodes);

    /// In any step.
    bool is_held(Index node, int freedom) const { return given_.contains({node, freedom}); }
    /// In all steps.
    bool is_always_held(Index node, int freedom) const;
    /// In all steps in which `node` is, `other` is, too.
    bool is_held_with(Index node, Index other, int freedom) const;

    /// Reads the line of a *BOUNDARY card that the reader is on, behind its first entry.
    static Line read_line(const DeckView& deck, const Numbers& nodes, NumberOrSet what, CardReader line);

private:
    std::vector<char> steps(Index node, int freedom) const;

    int step_count_ = 1;
    std::set<int> starts_;  // steps that release what was held before (OP=NEW)
    std::map<std::pair<Index, int>, std::set<int>> given_;
};

}  // namespace femscalpel
