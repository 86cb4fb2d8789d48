// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Signed volume of a tetrahedron; positive when d lies on the side of the face a-b-c its normal points to.
inline double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) / 6;
}

/// x^(-1/3) of a positive normal number, to rounding: a guess from the exponent, then two fourth-order
/// Householder steps. Several times faster than 1 / std::cbrt(x), which relaxation would spend much of its time in.
inline double inverse_cube_root(double x) {
    double y = std::bit_cast<double>(0x553ee00000000000u - std::bit_cast<std::uint64_t>(x) / 3);
    for (int step = 0; step < 2; ++step) {
        const double e = 1 - x * y * y * y;
        y += y * e * (1.0 / 3 + e * (2.0 / 9 + e * (14.0 / 81)));
    }
    return y;
}

/// Mean ratio 12 (3V)^(2/3) / sum of squared edge lengths of a tetrahedron: 1 when equilateral, 0 when
/// flat, negative when inverted. Liu and Joe, BIT 34 (1994), "Relationship between tetrahedron shape measures".
double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Whether that mean ratio is below `limit` (positive), or not a number; mostly without taking a root.
bool mean_ratio_below(double limit, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Mean ratio 4 sqrt(3) A / sum of squared edge lengths of a triangle; never negative.
double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c);

/// Mean ratio of an element by its corner nodes. For quadrangles, pyramids, prisms and hexahedra: the
/// smallest over the corners' tetrahedra (triangles), each scaled so that the regular element has 1; negative
/// for a quadrangle that crosses itself, two of whose corners turn against the others. 1 for points and segments.
double mean_ratio(const Mesh& mesh, CellType type, Index cell);

/// Mean ratios of all elements of one type, in their order.
std::vector<double> mean_ratios(const Mesh& mesh, CellType type);

/// Length, area or volume of an element, by Gauss integration on its own shape functions where it is
/// quadratic or not a simplex; 0 for points. Volumes are signed.
double cell_measure(const Mesh& mesh, CellType type, Index cell);

/// The same of an element with its nodes at these points.
double cell_measure(CellType type, std::span<const Vec3> nodes);

}  // namespace femscalpel
