// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "groups/band_boundaries.h"
#include "mesh/band_mesh.h"

namespace femscalpel {

/// Marks the nodes on faces of only one tetrahedron of the band (its rim included), without matching faces: a
/// fingerprint of the faces of each node, where those between two tetrahedra cancel. (That others do by accident has a
/// chance of 2^-64.)
void mark_outer_nodes(const BandMesh& band, std::vector<char>& marked);

/// The faces of the band's tetrahedra that have a movable node and only nodes that count, in rows by their smallest
/// node: a row is short and in one place, which beats a hash table.
class TetraFaces {
public:
    TetraFaces() = default;
    /// `counts`: by node of the band.
    TetraFaces(const BandMesh& band, const std::vector<char>& counts);

    /// Index in `faces` of the face with these nodes in any order, or -1.
    int find(const std::array<int, 3>& nodes) const;

    std::vector<BandBoundaries::Face> faces;  ///< without kinds and elements

private:
    std::vector<int> start_;
};

}  // namespace femscalpel
