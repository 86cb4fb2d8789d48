// SPDX-License-Identifier: LGPL-2.1-or-later
#include "voxel_skin.h"

#include <array>
#include <map>

namespace femscalpel::checks {

VoxelSkin voxel_skin(int nx, int ny, int nz, const std::function<bool(int, int, int)>& is_there) {
    using Place = std::array<int, 3>;
    VoxelSkin skin;
    std::map<Place, int> nodes;
    const auto node = [&](const Place& p) {
        const auto [at, is_new] = nodes.emplace(p, static_cast<int>(skin.points.size()));
        if (is_new) skin.points.emplace_back(p[0], p[1], p[2]);
        return at->second;
    };
    const auto filled = [&](const Place& p) {
        const bool inside = p[0] >= 0 && p[1] >= 0 && p[2] >= 0 && p[0] < nx && p[1] < ny && p[2] < nz;
        return inside && is_there(p[0], p[1], p[2]);
    };
    const auto face = [&](const Place& p, int axis, int side) {
        Place a = p;
        a[axis] += side;
        Place b = a, c = a, d = a;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        ++b[u], ++c[u], ++c[v], ++d[v];
        const int ia = node(a), ib = node(b), ic = node(c), id = node(d);
        skin.triangles.push_back(side ? Triangle{ia, ib, ic} : Triangle{ia, ic, ib});
        skin.triangles.push_back(side ? Triangle{ia, ic, id} : Triangle{ia, id, ic});
    };
    for (int x = 0; x < nx; ++x)
        for (int y = 0; y < ny; ++y)
            for (int z = 0; z < nz; ++z)
                for (int axis = 0; axis < 3 && filled({x, y, z}); ++axis)
                    for (const int side : {0, 1}) {
                        Place beside{x, y, z};
                        beside[axis] += side ? 1 : -1;
                        if (!filled(beside)) face({x, y, z}, axis, side);
                    }
    return skin;
}

}  // namespace femscalpel::checks
