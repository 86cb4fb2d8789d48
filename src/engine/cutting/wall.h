// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <set>
#include <vector>

#include "cutting/workpiece.h"
#include "groups/covered.h"

namespace femscalpel {

/// A part of the skin of a band (of the border of its shells) that is to be moved. Where surfaces of the kept geometry
/// part it, it has several patches.
struct Wall {
    /// What of it was one surface (curve).
    struct Patch {
        int shape;               ///< surface (of shells: curve) of the kept geometry that it was
        std::vector<int> parts;  ///< slots in BandMesh::skin (creases) of the input
        bool follows = false;    ///< tangent to others, which it goes with
    };
    bool faces = true;               ///< of faces, which are in BandMesh::cut_faces now; else of edges, in cut_edges
    std::vector<Patch> patches;      ///< by the tag of these
    std::vector<int> nodes;          ///< ascending
    std::set<int> surfaces, curves;  ///< of the kept geometry that end at the wall
};

/// Finds in the band what a group covers, and takes it out of what is kept there (NodeConstraints::release()): its
/// parts go to BandMesh::cut_faces (cut_edges). Parts that are `following`, by nodes of the mesh as in Covered, are
/// patches of their own. Nothing may have moved yet. Throws ToolError when a part is none of the band's, or no skin.
Wall release_wall(Workpiece& f, const Covered& covered, const std::vector<std::array<Index, 3>>& following = {});

/// Points of a surface, and its normals between them.
struct SurfaceSample {
    std::vector<Vec3> points, normals;
};

/// Those of facets of the kept geometry.
SurfaceSample sample_of(const KeptGeometry& g, const std::vector<int>& facets);

/// For the border of a plane shell: lines and circles in it are planes and cylinders across it, which points of one
/// plane do not tell. So they are doubled, above it.
void double_across(SurfaceSample& sample, const Vec3& normal, double height);

/// Surfaces that end at the wall go on beyond it from now on: those that are a cylinder or a sphere, to rounding, as
/// such, others in their tangent planes; likewise bent lines.
void go_on_beside(Workpiece& f, const Wall& wall);

/// Tags of the wall's parts around a node, ascending.
std::vector<int> wall_tags(const BandMesh& band, int node);

/// Whether a node is one of the wall.
inline bool is_on_wall(const BandMesh& band, int node) {
    return !band.cut_faces.around(node).empty() || !band.cut_edges.around(node).empty();
}

}  // namespace femscalpel
