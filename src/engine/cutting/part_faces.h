// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cutting/rebuild.h"
#include "mesh/changes.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// A mesh parted along faces that it has already.
struct Parted {
    Mesh mesh;
    Changes changes;
    std::vector<CellRef> changed;  ///< elements that have other nodes now
    std::vector<CellRef> added;    ///< twins and lips; listed after those of the input in their blocks
    std::vector<Index> doubled;    ///< nodes (indices) of the input that have copies
    Index closed = 0;              ///< faces whose nodes are all where the crack ends: they could not be opened
    Index bridges = 0;             ///< of `whole`, shells
    Index whole = 0;               ///< segments and points that end on doubled nodes, and stay with the original
};

/// How the new groups are called.
struct PartedNames {
    std::string negative, positive, front;
};

/// Opens the faces inside the solids of `mesh` (edges, where it has none, between its shells) that a group covers: an
/// element group the faces its elements lie on, a facet group its facets, a node group those of which it has all
/// corners. Elements of any type. At each node the elements fall into parts that hang together by other faces; the
/// largest part on the negative side keeps the node, the others get copies in the same node groups. Negative is the
/// side that the facets belong to, or that the normals of the elements point away from (segments: that on their left);
/// with a node group, or where they do not agree, what most of them say; without any, normals point to larger x, y, z.
///
/// An element on such a face stays on the negative side, and gets a twin in its groups on the other; where there is
/// none, a new one is made on both, normals out of the material. They are in `negative` and `positive`. The edges where
/// the crack ends inside a solid are segments of the element group `front`, in order; in shells its tips are a node
/// group. New numbers are from `numbering` on.
///
/// Throws ToolError that names `group` where it covers no face, none inside, or none that can be opened, or has
/// elements of the mesh's own dimension.
Parted part_along(const Mesh& mesh, GroupIndex group, const PartedNames& names, const Numbering& numbering);

/// The same for the faces that lie on a surface, by the nodes' signed distances from it: all corners are within
/// `rounding`. The surface must not pass through an element. Nothing when no such face is inside.
std::optional<Parted> part_along(const Mesh& mesh, const std::vector<double>& distance, double rounding,
                                 const PartedNames& names, const Numbering& numbering);

}  // namespace femscalpel
