// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <set>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Three nodes of a face.
using Triangle = std::array<int, 3>;
/// Four nodes of an element.
using Tetra = std::array<int, 4>;
/// An edge of a face, in its direction.
using DirectedEdge = std::array<int, 2>;

/// The nodes in ascending order.
Triangle sorted(Triangle face);

/// All edges of some triangles.
std::set<DirectedEdge> directed_edges(std::span<const Triangle> triangles);

/// Volume that triangles enclose, their normals pointing outwards.
double enclosed_volume(std::span<const Vec3> points, std::span<const Triangle> triangles);

/// Triangles do not bound a volume that could be filled.
class CavityError : public QualityError {
public:
    /// `why`, such as "an open edge", and where.
    CavityError(const char* why, const Vec3& at);

    const char* const why;
    const Vec3 at;
};

/// Throws CavityError that names the place where triangles do not bound a volume: an edge that is not run through as
/// often in one direction as in the other, a triangle that is there twice or flat, two that cross, nothing enclosed
/// (normals that point inwards, too). Where bounding bodies touch at an edge, four triangles share it.
void check_cavity(std::span<const Vec3> points, std::span<const Triangle> triangles);

/// The edge at which the inside is sharpest.
struct SharpestEdge {
    Vec3 at = Vec3::Zero();
    double degrees = 360;
};
/// Of a closed surface whose normals point outwards, that edge and the angle there.
SharpestEdge sharpest_edge(std::span<const Vec3> points, std::span<const Triangle> triangles);

/// Smallest mean ratio of tetrahedra that fill what the triangles enclose. Throws QualityError that names the place
/// where they do not: a flat or inverted one, a triangle that is not exactly one's outer face, another outer face, a
/// total volume that is not the enclosed one to 1e-9.
double check_filling(std::span<const Vec3> points, std::span<const Triangle> triangles, std::span<const Tetra> tetras);

}  // namespace femscalpel
