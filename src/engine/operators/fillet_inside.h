// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "cancel.h"
#include "cutting/workpiece.h"
#include "operators/fillet_path.h"

namespace femscalpel {

/// Middle of an element of a band's list.
template <std::size_t N>
Vec3 middle_of(const BandMesh& band, const std::array<int, N>& nodes) {
    Vec3 sum = band.nodes[nodes[0]].at;
    for (std::size_t k = 1; k < N; ++k) sum += band.nodes[nodes[k]].at;
    return sum / static_cast<double>(N);
}

/// The elements of a list of the band (tetrahedra, or shells) between the walls of a fillet, no farther along its path
/// than `reach` beyond the ends, that are joined to the edge through faces (edges); ascending. What is no farther than
/// `near` from the path is at the edge.
template <std::size_t N>
std::vector<int> elements_inside(const Workpiece& f, const SimplexList<N>& list, const FilletPath& path, double reach,
                                 double near) {
    const BandMesh& band = f.d.band;
    const auto is_inside = [&](const std::array<int, N>& n) {
        const Vec3 middle = middle_of(band, n);
        for (const int side : {0, 1}) {
            const Tool& wall = path.wall(side);
            if (wall.distance(middle) >= 0) return false;
            for (const int v : n)
                if (f.value(v, wall) > 10 * f.tolerance) return false;
        }
        return std::ranges::all_of(n, [&](int v) { return path.distance(band.nodes[v].at, reach) <= reach; });
    };
    std::vector<char> seen(static_cast<std::size_t>(list.size()), 0);
    std::vector<int> queue, out;
    const auto visit = [&](int s) {
        if (seen[s] != 0) return;
        seen[s] = 1;
        if (is_inside(list[s])) queue.push_back(s);
    };
    for (int v = 0; v < band.size(); ++v)
        if (path.distance(band.nodes[v].at, 0) <= near && band.in_use(v))
            for (const int s : list.around(v)) visit(s);
    while (!queue.empty()) {
        check_cancelled();
        const int s = queue.back();
        queue.pop_back();
        out.push_back(s);
        for (const int v : list[s])
            for (const int other : list.around(v)) {
                const auto shared = std::ranges::count_if(
                    list[other], [&](int w) { return std::ranges::find(list[s], w) != list[s].end(); });
                if (shared == static_cast<std::ptrdiff_t>(N) - 1) visit(other);
            }
    }
    std::ranges::sort(out);
    return out;
}

}  // namespace femscalpel
