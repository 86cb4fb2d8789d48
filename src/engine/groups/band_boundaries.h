// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/band_mesh.h"

namespace femscalpel {

/// The faces, edges and nodes of a BandMesh on which groups have their boundary (see virtual_boundary()), the
/// band's skin included: what moving nodes have to keep to (paper, 4.1).
///
/// A `kind` stands for the set of groups that have their boundary at an entity; 0 is the empty set. Faces of
/// one kind may be joined to one surface, lines of one kind to one curve; where the kind changes, a boundary ends.
///
/// Differences from virtual_boundary(), for the purpose:
/// - Faces and segments that are *members* are kept even inside an area they enclose, as the elements they are.
/// - Node groups: a face through the material is not kept if all its nodes lie on faces of the same group that are kept
///   anyway (skin, borders between volume groups, members), nor is such an edge. (A support on two sides of a corner
///   has such shortcuts in every corner element. Its nodes keep to the faces; pinning them to the shortcut too would
///   freeze the corner.) At the rim of the band, where not all faces are known, shortcuts are kept.
/// - Entities of outer nodes only, which never move, are left out.
/// - Groups whose boundary may drift count for nothing, and so do triangles on faces of tetrahedra, segments and
///   facets that are in such groups alone.
///
/// The cost is that of the band, whatever the number of groups: groups are handled as families.
class BandBoundaries {
public:
    /// A face of a tetrahedron, or a shell.
    struct Face {
        std::array<int, 3> nodes;          ///< band nodes; normal out of tetra[0]
        int kind = 0;                      ///< groups with BE or LE here; for a shell, those it is part of
        std::array<int, 2> tetra{-1, -1};  ///< slots of the tetrahedra behind and in front; none for a shell
        bool element = false;              ///< a triangle element or a facet that is to be kept lies here
        bool is_shell() const { return tetra[0] < 0; }
        bool is_skin() const { return tetra[0] >= 0 && tetra[1] < 0; }
        bool is_internal() const { return tetra[1] >= 0; }
    };
    /// An edge in LE of a group, or one with a segment element or a facet that is to be kept.
    struct Line {
        std::array<int, 2> nodes;
        int kind = 0;
        bool element = false;
    };
    /// A face or an edge (its last node is there twice) through the material that is in LE or BE of node groups but is
    /// not kept.
    struct Shortcut {
        std::array<int, 3> nodes;
        int kind;
    };
    /// A node in IE of a group: it must not move.
    struct Node {
        int node;
        int kind;
    };

    /// Analyses `band`. Groups with drifting[g] count for nothing; if `drifting` is empty, hidden groups do.
    /// `on_shortcuts`: numbers, ascending, of nodes that were born on shortcuts: they count as nodes on kept faces of
    /// their groups. `meaningless`: by group index, groups that drift as hidden ones do: an element in no other group
    /// is in none.
    BandBoundaries(const BandMesh& band, const Mesh& mesh, const std::vector<bool>& drifting = {},
                   std::span<const Index> on_shortcuts = {}, const std::vector<bool>& meaningless = {});

    /// Every face of a tetrahedron that is skin, or has a kind, or has an element; every shell. Each once, also where
    /// several shells have the same nodes: its groups are those of all.
    std::span<const Face> faces() const { return faces_; }
    std::span<const Line> lines() const { return lines_; }
    std::span<const Shortcut> shortcuts() const { return shortcuts_; }
    /// Ascending. A mid-side node of IE is represented by both ends of its edge.
    std::span<const Node> isolated() const { return isolated_; }

    /// The groups of a kind, ascending.
    std::span<const GroupIndex> groups(int kind) const { return sets_.groups(kind); }

    /// All kinds.
    const FamilyTable& kinds() const { return sets_; }

    /// An edge (ends ascending) whose mid-side node is in IE of a group.
    std::span<const std::array<int, 2>> isolated_middles() const { return isolated_middles_; }

private:
    class Finder;
    FamilyTable sets_;
    std::vector<Face> faces_;
    std::vector<Line> lines_;
    std::vector<Shortcut> shortcuts_;
    std::vector<Node> isolated_;
    std::vector<std::array<int, 2>> isolated_middles_;
};

}  // namespace femscalpel
