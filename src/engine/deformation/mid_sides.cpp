// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/mid_sides.h"

#include <cmath>
#include <limits>

namespace femscalpel {

MidSides::MidSides(const BandMesh& band, const Mesh& mesh, double rounding) : any_(!band.mid_nodes.empty()) {
    for (const auto& [key, mid] : band.mid_nodes) {
        const Vec3 &a = band.nodes[static_cast<int>(key >> 32)].at, &b = band.nodes[static_cast<int>(key & 0xffffffffu)].at;
        const Vec3 bulge = mesh.points[mid] - (a + b) / 2;
        // Text files round: what is straight to nine digits is straight.
        if (bulge.norm() > std::max(1e-8 * (a - b).norm(), rounding)) bulges_.emplace(key, bulge);
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
    // Bent edges add to the Jacobian of the straight element, each by its bulge times the gradient of its shape function
    // 4 l_a l_b. Mid-side nodes: 01 12 20 03 13 23.
    static constexpr int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    static const std::array<std::array<Vec3, 6>, 8> gradients = [] {
        const std::array<Vec3, 4> slope{Vec3(-1, -1, -1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
        const double near = (5 + 3 * std::sqrt(5.0)) / 20, far = (5 - std::sqrt(5.0)) / 20;  // integration points
        std::array<std::array<Vec3, 6>, 8> out;
        for (int p = 0; p < 8; ++p) {
            std::array<double, 4> l;
            l.fill(p < 4 ? far : 0);
            l[p % 4] = p < 4 ? near : 1;
            for (int k = 0; k < 6; ++k) out[p][k] = 4 * (l[ends[k][0]] * slope[ends[k][1]] + l[ends[k][1]] * slope[ends[k][0]]);
        }
        return out;
    }();
    std::array<Vec3, 6> bulge;
    std::array<int, 6> bent;
    int count = 0;
    for (int k = 0; k < 6; ++k) {
        bulge[k] = x[4 + k] - (x[ends[k][0]] + x[ends[k][1]]) / 2;
        if (!bulge[k].isZero(0)) bent[count++] = k;
    }
    const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
    double smallest = std::numeric_limits<double>::infinity();
    for (const auto& g : gradients) {
        Vec3 u = a, v = b, w = c;
        for (int i = 0; i < count; ++i) {
            const Vec3& off = bulge[bent[i]];
            const Vec3& slope = g[bent[i]];
            u += off * slope[0];
            v += off * slope[1];
            w += off * slope[2];
        }
        smallest = std::min(smallest, u.cross(v).dot(w));
    }
    return smallest / a.cross(b).dot(c);
}

}  // namespace femscalpel
