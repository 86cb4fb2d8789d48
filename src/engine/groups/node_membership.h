// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "mesh/band_mesh.h"

namespace femscalpel {

/// The node groups that each node of a band is in while the band is split (resources/docs/groups.md; paper, 4.2): a
/// node born on an edge is in those of both its ends, which are the ones with the edge in LE, in BE or inside BE (see
/// virtual_boundary()); one that was the edge's mid-side node keeps its own, and joins those of both ends that have
/// none of the mid-side nodes around these: a group of corners alone has the new corner, too. Hidden groups count as
/// well, but for that.
class NodeMembership {
public:
    NodeMembership(const BandMesh& band, const Mesh& mesh);

    /// Must be called after BandMesh::split_edge() made `node`.
    void add_node(const BandMesh& band, int node);

    /// The node groups of a band node.
    std::span<const GroupIndex> groups(int node) const { return families_.groups(in_[node]); }

    /// Whether a mid-side node of the input may become that of the edge a-b instead of its own: all its groups have
    /// both ends, and none is hidden.
    bool may_hand_over(Index middle, int a, int b) const;

    /// Whether moving node `p` onto its neighbour `t` (BandMesh::merge_node()) would link members of a group that
    /// were not linked: as corners of an edge, face or tetrahedron that is not there yet. A node born on such an edge
    /// later would join the group through isolated nodes.
    bool merge_links(const BandMesh& band, int p, int t) const;

private:
    FamilyTable families_;
    std::vector<bool> hidden_;                          // groups
    std::vector<FamilyIndex> in_;                       // by band node
    std::vector<FamilyIndex> middles_;                  // likewise: of the mid-side nodes on edges of the node
    std::unordered_map<Index, FamilyIndex> of_middle_;  // mid-side nodes in a group, by index in the mesh
};

}  // namespace femscalpel
