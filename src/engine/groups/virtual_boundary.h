// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Nodes, edges and faces of a group's boundary by their corner nodes, each once. An edge or face may lie
/// on an element of the mesh, but need not.
struct BoundaryPart {
    std::vector<Index> nodes;                 ///< node indices
    std::vector<std::array<Index, 2>> edges;  ///< node indices
    std::vector<std::array<Index, 4>> faces;  ///< node indices; a triangle has -1 in the fourth place
    /// The element on each edge or face - the group's own if there is one - with cell -1 where there is none.
    std::vector<CellRef> edge_elements;
    std::vector<CellRef> face_elements;
};

/// Virtual group boundary (VGB) of one group; see virtual_boundary().
struct VirtualBoundary {
    BoundaryPart bounding;          ///< BE: faces of a 3-D mesh or edges of a 2-D mesh, out of or around the area
    BoundaryPart linking;           ///< LE: faces (3-D mesh) and edges
    BoundaryPart isolated;          ///< IE: nodes
    std::vector<CellRef> enclosed;  ///< the area: elements of the mesh's dimension inside BE, in mesh order
};

/// The virtual group boundary of paper section 4.2: what of the mesh a group covers, by dimension.
///
/// d is the mesh's dimension (that of its largest elements; shells in a mesh with volume elements are faces
/// of a 3-D mesh). With "belongs": a node, edge, face belongs to a *node* group if all its corner nodes do; to
/// an *element* or *facet* group if one of the group's elements or facets lies on it, or, for a face, if all
/// its edges belong.
///
/// - Area: elements of dimension d in the group, and those whose nodes all (node group), edges all (edges),
///   faces all (faces) belong.
/// - BE: faces (d = 3) or edges (d = 2) with the area on exactly one side.
/// - LE: faces (d = 3 only) that belong and are no face of the area; edges that belong and are no edge of the
///   area or of a face of LE.
/// - IE: nodes of the group (or of its point elements) on none of these.
///
/// The seven cases of the paper are this rule for groups of one kind of member. Where its text leaves a
/// choice, this one was made:
///
/// 1. "Faces in a 2-D mesh", fifth item of the list, is read as faces in a 3-D mesh (the second of that name,
///    among the items on 3-D meshes).
/// 2. Nodes in 2-D, LE are "the edges associated to faces having exactly two group nodes": an edge of the
///    area can have such a face on its other side. It is BE then, not LE also: BE, LE, IE and the
///    inside of the area are disjoint. Likewise the triangles in 3-D "associated to tetrahedrons having exactly three
///    group nodes" and "tetrahedrons having less than 6 edges", and the edges "associated with triangles
///    having exactly 2 nodes": *all* such faces, tetrahedra and triangles around must be so.
/// 3. Edges in 3-D, "the group edges which associate with any BE triangles" is read as those which do not: edges
///    of BE are covered by it. So are edges of LE triangles.
/// 4. "IE contains the nodes associated to edges having only one node in the group": *all* edges at the node
///    must be so. (Any node at the rim of a group has one such edge, the aligned nodes of Figure 9 too.)
/// 5. A group of faces or edges has no IE by this text: what encloses nothing becomes LE. Point elements,
///    which the paper does not have, are IE unless the rest of their group covers them.
/// 6. Node groups: an edge through the material between two nodes of a group counts as any other, as the text
///    says, though the nodes may be on two faces of a corner. A field prescribed at both ends is prescribed
///    all along the edge by the element's own shape functions; a node born there that did not join would loosen it.
///    (Operators need not keep the *shape* of such edges and faces: see BandBoundaries.)
/// 7. Several shells on one edge: BE is where the area has exactly one of them. Coincident elements count once.
/// 8. Meshes of dimension 0 and 1 have no area: edges are LE.
///
/// It follows that an edge has both ends in a node group exactly when it lies on LE or on or inside BE. So the
/// rule "born on LE or inside BE joins, nothing joins through IE" gives a node born on an edge exactly
/// the node groups of both its ends (FamilyTable::intersect), and Figure 9 is right: consecutive
/// nodes on the border of a shell are linked, and the node born between n1 and n2 joins.
/// Splitting keeps this true: what is all in the group among the parts is exactly the parts of what was. Merging nodes
/// need not, so operators merge none that would link members anew (NodeMembership::merge_links).
///
/// Second-order elements count by their corners. A mid-side or centre node of a node group is IE unless all
/// corners of its edge, face or element are in the group.
///
/// Faces of BE have their normal out of the area, edges of BE run as their element does.
/// Linear in the mesh. Throws Error when there is no such group.
VirtualBoundary virtual_boundary(const Mesh& mesh, GroupIndex group);

/// virtual_boundary() for many groups of one mesh: sets up in linear time; each group then costs only the
/// elements at its nodes. Holds a reference to the mesh, which must not change.
class VirtualBoundaryFinder {
public:
    explicit VirtualBoundaryFinder(const Mesh& mesh);
    ~VirtualBoundaryFinder();
    VirtualBoundaryFinder(VirtualBoundaryFinder&&) noexcept;

    /// As femscalpel::virtual_boundary().
    VirtualBoundary find(GroupIndex group) const;

private:
    struct Tables;
    std::unique_ptr<const Tables> tables_;
};

}  // namespace femscalpel
