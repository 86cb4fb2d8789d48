// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <unordered_map>
#include <vector>

#include "cutting/rebuild.h"
#include "cutting/weld.h"
#include "cutting/weld_springs.h"
#include "mesh/changes.h"

namespace femscalpel {

/// What taking welded nodes apart did to a mesh.
struct Unwelded {
    /// Of nodes that were single (by number): those at the same place now, their partners.
    std::unordered_map<Index, std::vector<Index>> partners;
    Index moved = 0;    ///< partners that are the input's, and lie elsewhere now
    Index born = 0;     ///< new ones of nodes born meanwhile, less those that no element has in the end
    Index doubled = 0;  ///< new ones of nodes doubled meanwhile
    Index removed = 0;  ///< nodes of the input that no element has any more, that of the operation were not
    Index joined = 0;   ///< welded faces that could not be taken apart: the result is of no use then
    /// Copies of segments that the operation made on shells, for those on the other side; by number.
    std::vector<Index> segments;
    WeldSprings springs;
};

/// Makes double what weld() made single in what an operation made of Welded::mesh: each element goes to the side that
/// the element of `input` it descends from was on. The input's nodes have their numbers and groups again, at the places
/// they moved to; a node born meanwhile gets a partner, in the node groups that all its ancestors of that side are in,
/// as does a node doubled by a crack, in its groups. Partners that no element has any more go. Segments between double
/// nodes are there again, see put_back_springs(). New nodes and elements
/// are numbered from `next` on, nodes added to `changes`, which are those between `input` and `mesh` (in_one()).
Unwelded unweld(const Mesh& input, const Welded& welded, Mesh& mesh, Changes& changes, Numbering next);

}  // namespace femscalpel
