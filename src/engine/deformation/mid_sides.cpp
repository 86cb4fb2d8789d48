// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/mid_sides.h"

#include <Eigen/LU>

#include "mesh/quality.h"

namespace femscalpel {

MidSides::MidSides(const BandMesh& band, const Mesh& mesh) : any_(!band.mid_nodes.empty()) {
    for (const auto& [key, mid] : band.mid_nodes) {
        const Vec3 &a = band.nodes[static_cast<int>(key >> 32)].at, &b = band.nodes[static_cast<int>(key & 0xffffffffu)].at;
        const Vec3 bulge = mesh.points[mid] - (a + b) / 2;
        // Text files round: what is straight to nine digits is straight.
        if (bulge.norm() > 1e-8 * (a - b).norm()) bulges_.emplace(key, bulge);
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

double curved_ratio(const std::array<Vec3, 10>& x) {
    const double straight = signed_volume(x[0], x[1], x[2], x[3]);
    double smallest = smallest_jacobian(x);
    // At a corner the columns of the Jacobian are the tangents of its edges. Mid-side nodes: 01 12 20 03 13 23.
    constexpr int corner[4][7] = {{0, 1, 4, 2, 6, 3, 7}, {1, 2, 5, 0, 4, 3, 8}, {2, 0, 6, 1, 5, 3, 9}, {3, 0, 7, 2, 9, 1, 8}};
    for (const auto& c : corner) {
        const auto tangent = [&](int end, int mid) { return Vec3(4 * x[mid] - 3 * x[c[0]] - x[end]); };
        smallest = std::min(smallest, tangent(c[1], c[2]).cross(tangent(c[3], c[4])).dot(tangent(c[5], c[6])) / 6);
    }
    return smallest / straight;
}

}  // namespace femscalpel
