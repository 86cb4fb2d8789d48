// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "cutting/numbering.h"
#include "cutting/opening.h"
#include "cutting/workpiece.h"
#include "mesh/changes.h"

namespace femscalpel {

/// A band written back into its mesh.
struct Rebuilt {
    Mesh mesh;
    std::vector<Index> node;      ///< index in `mesh` of each band node, then of each copy; -1 if unused
    std::vector<CellRef> before;  ///< elements of the input that were changed (indices in the input)
    std::vector<CellRef> after;   ///< what they became, and what was added (indices in `mesh`)
    Changes changes;              ///< where new nodes and elements come from, by number
    Index nodes_split = 0;
    Index nodes_doubled = 0;
    Index nodes_removed = 0;
    Index elements_added = 0;
    Index elements_removed = 0;
    std::vector<Index> place;  ///< index in `mesh` of each node of the input, -1 if gone; empty when none is

    Index kept_node(Index input_node) const { return place.empty() ? input_node : place[input_node]; }
};

/// Puts the band's changes into `copy`, a copy of `input`: moved nodes, split elements, doubled nodes, lip elements in
/// all groups of `groups[Opening::Face::group]` (appended to the mesh's groups, in that order), removed elements and
/// the nodes that only they had. Everything else is the input's, bit for bit. Children inherit the groups of their
/// parent; a node born on an edge is in the node groups of both ends; a copied node is in all groups of its original.
/// New nodes and elements are numbered from `numbering` on.
///
/// A group that has no faces or edges to hold, but ends of beams (Opening::ends), is one of these nodes.
///
/// The segments of Opening::front_chains go to the element group `front`, in their order.
///
/// Mid-side nodes follow their edges in the band, see mid_side(); or lie where Workpiece::mid_side says.
Rebuilt rebuild(const Mesh& input, Mesh copy, const Workpiece& workpiece, const Opening& opening,
                const std::vector<std::vector<std::string>>& groups, const Numbering& numbering,
                const std::string& front = {});

}  // namespace femscalpel
