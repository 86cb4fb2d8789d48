// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "deck/node_origins.h"

namespace femscalpel {

/// A linear equation between nodes, as a *EQUATION card has it.
struct NodeEquation {
    /// One summand: `factor` times a degree of freedom of a node.
    struct Term {
        Index node;  ///< number
        Index dof;
        double factor;
        std::string written;  ///< "dof, factor" as in the deck
    };
    std::vector<Term> terms;
};

/// What becomes of equations where an operator made new nodes.
struct RelatedNodes {
    /// A new equation: that of `like`, term for term, but with these nodes.
    struct Made {
        std::size_t like;
        std::vector<Index> nodes;
    };
    /// A new node that should be related and is not.
    struct Missed {
        std::size_t like;  ///< an equation of a node it was born at
        Index node;
    };
    std::vector<Made> made;
    std::vector<Missed> missed;       ///< nodes born between related nodes, without a partner
    std::vector<Missed> one_sided;    ///< copies of nodes born, their partners are not doubled
    std::vector<char> copies_follow;  ///< by equation: its doubled nodes' copies are related as they are
};

/// Relates what is new between and beside related nodes. A node born between nodes that have equations of one shape -
/// the same degrees of freedom and factors, itself in the same term - gets an equation of that shape: each further term
/// has the node that all the equations have there, or the new node that lies between theirs as it lies between its own
/// (the same shares in the old elements). So linear fields that the equations allowed are allowed as before. Where all
/// nodes of an equation are doubled, but for reference nodes that no element has, their copies get it too: those on the
/// positive side of a crack.
///
/// Double nodes that follow each other (Changes::facing) are the exception: each two that lie on each other get the
/// equations of the two pairs (or that pair) they come from, however many there are on either side.
///
/// Missed are nodes born between nodes whose equations have no shape in common, or whose partners have no new node at
/// that place.
RelatedNodes relate_new_nodes(const std::vector<NodeEquation>& equations, const Mesh& before,
                              const NumberIndex& numbers, const NodeOrigins& origins, const Changes& changes);

}  // namespace femscalpel
