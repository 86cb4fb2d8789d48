// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Signed volume of a tetrahedron; positive when d lies on the side of the face a-b-c its normal points to.
inline double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) / 6;
}

/// Mean ratio 12 (3V)^(2/3) / sum of squared edge lengths of a tetrahedron: 1 when equilateral, 0 when
/// flat, negative when inverted. Liu and Joe, BIT 34 (1994), "Relationship between tetrahedron shape measures".
double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Mean ratio 4 sqrt(3) A / sum of squared edge lengths of a triangle; never negative.
double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c);

/// Mean ratio of an element by its corner nodes. For quadrangles, pyramids, prisms and hexahedra: the
/// smallest over the corners' tetrahedra (triangles), each scaled so that the regular element has 1.
/// 1 for points and segments.
double mean_ratio(const Mesh& mesh, CellType type, Index cell);

/// Mean ratios of all elements of one type, in their order.
std::vector<double> mean_ratios(const Mesh& mesh, CellType type);

/// Length, area or volume of an element, by Gauss integration on its own shape functions where it is
/// quadratic or not a simplex; 0 for points. Volumes are signed.
double cell_measure(const Mesh& mesh, CellType type, Index cell);

/// Smallest Jacobian determinant of a 10-node tetrahedron at its four integration points (those of
/// CalculiX's C3D10 and Code_Aster's TETRA10), divided by six: a volume.
/// `nodes`: ten points in the order of CellType::tetra10.
double smallest_jacobian(const std::array<Vec3, 10>& nodes);

}  // namespace femscalpel
