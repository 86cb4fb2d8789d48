// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/mid_sides.h"

#include <cmath>
#include <limits>

namespace femscalpel {

MidSides::MidSides(const BandMesh& band, const Mesh& mesh, double rounding) : any_(!band.mid_nodes.empty()) {
    for (const auto& [key, mid] : band.mid_nodes) {
        const Vec3 &a = band.nodes[static_cast<int>(key >> 32)].at,
                   &b = band.nodes[static_cast<int>(key & 0xffffffffu)].at;
        const Vec3 bulge = mesh.points[mid] - (a + b) / 2;
        // Text files round: what is straight to nine digits is straight.
        if (bulge.norm() > std::max(1e-8 * (a - b).norm(), rounding))
            set_bulge(static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu), bulge);
    }
}

void MidSides::split(const BandMesh& band, int a, int b, int p, double t) {
    if (bulges_.empty()) return;
    const auto across = [&](const auto& list) {
        for (const int s : list.around(a)) {
            const auto& v = list[s];
            if (std::ranges::find(v, b) == v.end()) continue;
            for (const int c : v)
                if (c != a && c != b) set_bulge(p, c, bulge_across(a, b, c, t));
        }
    };
    across(band.tetras);
    across(band.triangles);
    const Vec3 whole = bulge(a, b);
    set_bulge(a, p, t * t * whole);
    set_bulge(p, b, (1 - t) * (1 - t) * whole);
}

namespace {

/// How a bent edge adds to the Jacobian of a straight simplex of dimension D, at its integration points and then at its
/// corners: its bulge times the gradient of its shape function 4 l_a l_b. Edges as in traits(): 01 12 20, and 03 13 23.
template <int D>
struct Bends {
    static constexpr int corners = D + 1, edges = D * (D + 1) / 2, samples = 2 * corners;
    static constexpr int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    using Gradient = std::array<double, D>;
    std::array<std::array<Gradient, edges>, samples> gradients;

    Bends() {
        const double near = D == 3 ? (5 + 3 * std::sqrt(5.0)) / 20 : 2.0 / 3,
                     far = (1 - near) / D;  // integration points
        for (int p = 0; p < samples; ++p)
            for (int k = 0; k < edges; ++k) {
                const auto [i, j] = ends[k];
                const auto weight = [&](int corner) {
                    return p % corners == corner ? (p < corners ? near : 1) : (p < corners ? far : 0);
                };
                for (int axis = 0; axis < D; ++axis)
                    gradients[p][k][axis] = 4 * (weight(i) * slope(j, axis) + weight(j) * slope(i, axis));
            }
    }

    static double slope(int corner, int axis) { return corner == 0 ? -1 : corner == axis + 1 ? 1 : 0; }
};

/// The smallest over the first `samples` of them.
template <int D>
double smallest_ratio(const Vec3* x, int samples) {
    using Shape = Bends<D>;
    static const Shape shape;
    std::array<Vec3, Shape::edges> bulge;
    std::array<int, Shape::edges> bent;
    int count = 0;
    for (int k = 0; k < Shape::edges; ++k) {
        bulge[k] = x[Shape::corners + k] - (x[Shape::ends[k][0]] + x[Shape::ends[k][1]]) / 2;
        if (!bulge[k].isZero(0)) bent[count++] = k;
    }
    std::array<Vec3, D> straight;
    for (int axis = 0; axis < D; ++axis) straight[axis] = x[axis + 1] - x[0];
    Vec3 normal = Vec3::Zero();
    if constexpr (D == 2) normal = straight[0].cross(straight[1]);
    const auto size = [&](const std::array<Vec3, D>& column) {
        if constexpr (D == 2)
            return column[0].cross(column[1]).dot(normal);
        else
            return column[0].cross(column[1]).dot(column[2]);
    };
    double smallest = std::numeric_limits<double>::infinity();
    for (int p = 0; p < samples; ++p) {
        std::array<Vec3, D> column = straight;
        for (int i = 0; i < count; ++i)
            for (int axis = 0; axis < D; ++axis) column[axis] += shape.gradients[p][bent[i]][axis] * bulge[bent[i]];
        smallest = std::min(smallest, size(column));
    }
    return smallest / size(straight);
}

double smallest_ratio(std::span<const Vec3> nodes, bool at_corners) {
    return nodes.size() == 6 ? smallest_ratio<2>(nodes.data(), at_corners ? 6 : 3)
                             : smallest_ratio<3>(nodes.data(), at_corners ? 8 : 4);
}

}  // namespace

double curved_ratio(std::span<const Vec3> nodes) { return smallest_ratio(nodes, true); }

double integration_ratio(std::span<const Vec3> nodes) { return smallest_ratio(nodes, false); }

}  // namespace femscalpel
