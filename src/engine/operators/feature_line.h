// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// What names an edge of a part: one of these.
struct Along {
    std::string group;         ///< of segments or nodes
    std::vector<Index> nodes;  ///< numbers
    std::vector<Vec3> points;  ///< near feature lines
};

/// A feature line of the skin of solids, from one of its ends to the other; of a closed one the first node is not
/// repeated at the end.
struct FeatureLine {
    std::vector<Index> nodes;  ///< indices in the mesh
    bool closed = false;
    bool extended = false;  ///< it is longer than what was named
    /// Skin faces at each edge, normals outwards: the first has the edge in the line's direction.
    std::vector<std::array<std::array<Index, 3>, 2>> faces;
};

/// Triangles of the skin of the mesh's solids, by corners, normals outwards; quadrangular faces are two.
std::vector<std::array<Index, 3>> skin_of(const Mesh& mesh);

/// How a feature line ends, for what is swept along it.
enum class LineEnd {
    plane,   ///< in a plane face, through which it runs out of the part: none of the faces there goes on beyond
    wall,    ///< a concave line in a plane face that stands across it, and in which it ends
    open,    ///< in another way: its faces go on, several others or a curved one meet there
    joined,  ///< at a corner where it is joined to other lines; never found by line_ends()
};

/// Those at the beginning and the end of an open line.
std::array<LineEnd, 2> line_ends(const Mesh& mesh, const FeatureLine& line,
                                 const std::vector<std::array<Index, 3>>& skin);

/// A triangle of the skin at a line's end that lies across it and looks to it, that which rounded coordinates show
/// best; none where there is none.
std::optional<std::array<Index, 3>> wall_at_end(const Mesh& mesh, const FeatureLine& line, int which,
                                                const std::vector<std::array<Index, 3>>& skin);

/// The feature lines (edges of the skin sharper than `feature_angle`, degrees) that `along` names, each as long as it
/// goes on smoothly. Throws ToolError (parameter "along") when there is no such group or node, or no feature line
/// there.
std::vector<FeatureLine> find_feature_lines(const Mesh& mesh, const Along& along, double feature_angle);

}  // namespace femscalpel
