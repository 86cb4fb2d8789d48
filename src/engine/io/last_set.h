// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// The sets that a deck defines, as it is written, and whether CalculiX keeps those that have no members. At the end of
/// each *SURFACE card of elements it forgets the last set in the order of names, not the one of the card, if that one
/// has no end yet (surfaces.f: iendset(nset)): a surface without lines, or a set of an empty *NODE or *ELEMENT card
/// read before any set had a member. A set with a member that comes last saves them: a node once more, in a set of a
/// name behind all others. It is no part of the deck: remove_last_set() takes it out where a deck is read.
class DefinedSets {
public:
    /// A card that defines a set or adds to it. `by_mesh`: it is a *NODE or *ELEMENT card, which CalculiX reads before
    /// those of sets.
    void add(DeckSetType type, std::string_view name, bool has_members, bool by_mesh);

    /// CalculiX would forget a set.
    bool needs_last_set() const;

private:
    struct Definition {
        DeckSetType type;
        std::string key;  ///< as CalculiX sorts names
        bool has_members, by_mesh;
    };
    std::vector<Definition> definitions_;
};

/// The card with the last set, to be put before all *NODE cards; `node` is the line of a node, without its end.
std::string last_set_card(std::string_view node, std::string_view eol);

/// Takes what last_set_card() made out of a deck's cards; whether there was such a card.
bool remove_last_set(std::vector<Card>& cards);

}  // namespace femscalpel
