// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "mesh/surface.h"

namespace femscalpel {

/// Faces of a mesh's surface, of elements of any type, as triangles between corners (a quadrangle is two).
struct OuterFaces {
    std::vector<SurfaceFace> triangles;
    std::vector<Facet> owners;  ///< by triangle: the face it is of, without family; of a shell one with `face` 2

    /// An edge that only one shell has, and no solid's surface.
    struct Edge {
        std::array<Index, 2> nodes;
        Facet facet;   ///< without family
        int triangle;  ///< one of its shell
    };
    std::vector<Edge> edges;
};

/// Those of elements that reach into a box: faces that only one solid has, shells that are no face of a solid, and
/// their border. One pass over the elements.
OuterFaces outer_faces(const Mesh& mesh, const Eigen::AlignedBox3d& box);

}  // namespace femscalpel
