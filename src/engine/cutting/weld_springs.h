// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "cutting/weld.h"
#include "cutting/weld_sides.h"
#include "mesh/changes.h"

namespace femscalpel {

/// Nodes of a result that lie on each other, by number, and what of the input they come from.
struct WeldPair {
    Index node, other;
    WeldLabel of_node, of_other;
};

/// What became of the segments between double nodes.
struct WeldSprings {
    std::vector<CellRef> made;     ///< of the result: new ones
    std::vector<CellRef> removed;  ///< of the input: those that lost a node
};

/// Puts Welded::aside, springs and gaps of no length, back between the nodes that they had; and gives each new one of
/// `pairs` those that all pairs which it comes from have, numbered from `number` on and listed in `changes` as parts of
/// theirs. Where such segments are, the block is in the order of the input, then what is new.
WeldSprings put_back_springs(const Mesh& input, const Welded& welded, const std::vector<WeldPair>& pairs, Mesh& mesh,
                             Changes& changes, Index number);

}  // namespace femscalpel
