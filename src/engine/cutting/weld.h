// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Name of the hidden facet group that holds welded faces: one side of each.
inline constexpr std::string_view weld_group = "*WELD#";
/// Name of the hidden node group of the nodes where a weld ends inside the material.
inline constexpr std::string_view weld_rim_group = "*WELDRIM#";

/// A mesh whose double nodes are single for the time of an operation.
struct Welded {
    /// All nodes are there, at the same indices, but elements name only the first of each set. It is in the node groups
    /// of all of its set. Without `aside`.
    Mesh mesh;
    GroupIndex faces = 0;  ///< the group `weld_group`, whose faces are to stay where they are
    GroupIndex rim = 0;    ///< the group `weld_rim_group`: a face with all nodes in it could not be taken apart
    std::vector<std::vector<Index>> sets;  ///< nodes (indices, ascending) that were made one
    std::vector<CellRef> aside;            ///< segments between double nodes (springs, gaps of no length), of the input
    std::vector<std::array<Index, 2>> facing;  ///< of them, those on either side of a face: ascending, each pair once

    /// The node that stands for each.
    std::vector<Index> single_nodes() const;
    /// The pairs that they are: one less than the nodes of each set.
    Index pairs() const;
};

/// Welds the parts of a mesh that touch with double nodes (paper, 2.2 and Figure 3.f; resources/docs/groups.md): bodies
/// in contact, coincident shells, plane parts along a line, the lips of an earlier crack. Nodes are welded where faces
/// on the outside (border edges of shells, whole shells) lie on each other node for node, within `rounding`. Divisions
/// that do not match stay as they are. Nothing where no such nodes are.
std::optional<Welded> weld(const Mesh& mesh, double rounding);

}  // namespace femscalpel
