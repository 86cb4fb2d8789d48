// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "mesh/band_mesh.h"
#include "mesh/union_find.h"
#include "tools/cad_shape.h"

namespace femscalpel {

class BandBoundaries;

/// Which groups' boundaries are kept, and what counts as a feature line.
struct ConstraintOptions {
    double feature_angle = 30;          ///< degrees
    std::vector<bool> drifting_groups;  ///< by group index: boundary may drift; empty = all are kept
    std::vector<bool> meaningless;      ///< by group index: as if the group were not there; empty = none
    std::vector<bool> kept_hidden;      ///< by group index: hidden, but its boundary is kept; empty = none
    std::vector<Index> pinned;          ///< nodes (indices in the mesh, ascending) that must not move
    std::vector<Index> related;  ///< nodes (as pinned): one born on the skin between two of them must not move, so that
                                 ///< matching sides keep matching
    std::vector<Index>
        on_shortcuts;         ///< numbers of nodes, ascending, whose node groups have no boundary there: BandBoundaries
    std::vector<char> whole;  ///< by family: elements that cannot be divided, or empty (families_of_whole_elements())
    const CadShape* shape =
        nullptr;           ///< what the mesh was made from: its skin is taken to be this, where it lies on it
    double tolerance = 0;  ///< what is nearer than this to something lies on it
    double rounding = 0;   ///< what is flat or straight but for so much is so: a few times coordinate_rounding(), or 0
};

/// The cosine of the angle between the directions away from an edge (a node) below which no feature line (no corner)
/// is there.
double smooth_cosine(const ConstraintOptions& options);

/// A face of the band to be kept: skin, shell, or border of a group.
struct KeptFace {
    std::array<int, 3> nodes;
    int kind;       ///< faces that differ in this are never one surface
    int groups;     ///< those with their boundary here: a kind of BandBoundaries
    bool internal;  ///< between two tetrahedra
    bool shell;
    int cad;  ///< face of ConstraintOptions::shape it lies on, or -1
};

/// An edge of the band to be kept: surfaces part there, or a line of a group runs along it.
struct KeptCrease {
    std::array<int, 2> nodes;
    int kind;      ///< creases that differ in this are never one curve
    int groups;    ///< those with a linking edge here: a kind of BandBoundaries
    bool border;   ///< of a shell
    bool fold;     ///< the skin comes back along itself: the front of a crack
    int cad;       ///< edge of ConstraintOptions::shape it lies on, or -1
    int cad_face;  ///< face of that which all faces of the skin at the edge lie on, or -1
};

/// Number of faces of the skin and of shells, and of those that lie on no face of ConstraintOptions::shape.
struct ShapeMatch {
    Index faces = 0;
    Index off = 0;
};

/// The faces and edges of a band that are kept, and which faces go on as one smooth surface.
struct KeptParts {
    std::vector<KeptFace> faces;
    std::vector<KeptCrease> creases;
    UnionFind joined{0};  ///< faces in one set are one surface
    ShapeMatch match;
};

/// The faces of `boundaries`, and the edges among theirs and its lines that are creases: those with a movable node
/// which lie on a line, or where not just two faces meet, or two at the feature angle or of different kinds.
KeptParts find_kept_parts(const BandMesh& band, const BandBoundaries& boundaries, const ConstraintOptions& options);

}  // namespace femscalpel
