// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <unordered_map>
#include <vector>

#include "mesh/band_mesh.h"

namespace femscalpel {

/// The node groups that each node of a band is in while the band is split (resources/docs/groups.md; paper, 4.2): a
/// node born on an edge is in those of both its ends, which are the ones with the edge in LE, in BE or inside BE (see
/// virtual_boundary()); one that was the edge's mid-side node keeps its own. Hidden groups count as well.
class NodeMembership {
public:
    NodeMembership(const BandMesh& band, const Mesh& mesh);

    /// Must be called after BandMesh::split_edge() made `node`.
    void add_node(const BandMesh& band, int node);

    /// Whether moving node `p` onto its neighbour `t` (BandMesh::merge_node()) would link members of a group that
    /// were not linked: as corners of an edge, face or tetrahedron that is not there yet. A node born on such an edge
    /// later would join the group through isolated nodes.
    bool merge_links(const BandMesh& band, int p, int t) const;

private:
    FamilyTable families_;
    std::vector<FamilyIndex> in_;                       // by band node
    std::unordered_map<Index, FamilyIndex> of_middle_;  // mid-side nodes in a group, by index in the mesh
};

}  // namespace femscalpel
