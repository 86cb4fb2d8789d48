// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "deck/deck_view.h"

namespace femscalpel {

/// Nodes, by number, whose displacement a deck's cards set or relate to that of others, so that CalculiX may take them
/// for dependent.
class BoundNodes {
public:
    /// Nodes of *EQUATION, *MPC, *RIGID BODY, *COUPLING with *KINEMATIC, of the slave surfaces of *TIE, and supported
    /// ones under *TRANSFORM. None without a deck.
    explicit BoundNodes(const Mesh& mesh);

    /// Whether no equation can make this degree of freedom dependent, as a card does: of *EQUATION, that of the first
    /// term. Supports are not looked at. Slaves of *TIE without CYCLIC SYMMETRY can: CalculiX does not tie them then.
    bool is_dependent(Index node, int freedom) const {
        return dependent_.contains(node) || freedoms_.contains({node, freedom});
    }
    /// In any degree of freedom.
    bool is_bound(Index node) const { return bound_.contains(node); }
    /// So that it need not move with its neighbours in one body: as by *EQUATION, *MPC and *TIE.
    bool is_related(Index node) const { return related_.contains(node); }

    bool empty() const { return bound_.empty(); }

private:
    using Numbers = std::unordered_set<Index>;

    void collect(const DeckView& deck);
    void add_equations(const DeckView& deck, const Card& card);
    static void add_supported(const DeckView& deck, const Card& card, Numbers& to);
    static void add_set(const DeckView& deck, const std::string& name, Numbers& to);

    Numbers bound_, related_;  // as far as meshing has to mind them
    Numbers dependent_;        // in all degrees of freedom
    std::set<std::pair<Index, int>> freedoms_;
};

/// Degrees of freedom that a mesh's deck computes: displacements, the temperature. Displacements without a deck.
std::vector<int> computed_freedoms(const Mesh& mesh);

}  // namespace femscalpel
