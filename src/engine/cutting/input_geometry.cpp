// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/input_geometry.h"

#include <algorithm>

#include "cancel.h"

namespace femscalpel {

InputGeometry::InputGeometry(const BandMesh& band, const MidSides& mids, const Mesh& mesh) : band_(band) {
    for (const auto& [key, node] : band.mid_nodes) mids_.emplace(key, mesh.points[node]);
    for (const auto& [key, bulge] : mids.mended()) {
        const int a = static_cast<int>(key >> 32), b = static_cast<int>(key & 0xffffffffu);
        mids_[key] = (input(a) + input(b)) / 2 + mids.bulge(a, b);
    }
    SparseCheck check;
    const auto look = [&](const auto& list, std::vector<char>& curved) {
        curved.assign(static_cast<std::size_t>(list.size()), 0);
        for (int s = 0; s < list.size(); ++s, check())
            for (std::size_t i = 0; i < list[s].size(); ++i)
                for (std::size_t j = 0; j < i; ++j) curved[s] = curved[s] || bends(list[s][i], list[s][j]);
    };
    look(band.tetras, curved_tetras_);
    look(band.triangles, curved_triangles_);
    look(band.lines, curved_lines_);
}

Vec3 InputGeometry::middle(int a, int b) const {
    const auto mid = mids_.find(edge_key(a, b));
    return mid == mids_.end() ? at(between(a, b)) : mid->second;
}

bool InputGeometry::is_curved_around(int node) const {
    const auto any = [&](const auto& list, const std::vector<char>& curved) {
        return std::ranges::any_of(list.around(node), [&](int s) { return curved[list.origin(s)] != 0; });
    };
    return any(band_.tetras, curved_tetras_) || any(band_.triangles, curved_triangles_) ||
           any(band_.lines, curved_lines_);
}

bool InputGeometry::bends(int a, int b) const {
    const auto mid = mids_.find(edge_key(a, b));
    if (mid == mids_.end()) return false;
    return (mid->second - (input(a) + input(b)) / 2).norm() > 1e-10 * (input(a) - input(b)).norm();
}

InputGeometry::Place InputGeometry::between(int a, int b) const {
    Place out;
    for (const int v : {a, b}) {
        if (!band_.is_new(v)) {
            out.add(v, 0.5);
            continue;
        }
        const Place& p = born_[v - band_.original_nodes()];
        for (int k = 0; k < 4; ++k)
            if (p.node[k] >= 0) out.add(p.node[k], p.weight[k] / 2);
    }
    return out;
}

Vec3 InputGeometry::at(const Place& p) const {
    Vec3 x = Vec3::Zero();
    for (int i = 0; i < 4 && p.node[i] >= 0; ++i) {
        x += p.weight[i] * (2 * p.weight[i] - 1) * input(p.node[i]);
        for (int j = 0; j < i; ++j) {
            const auto mid = mids_.find(edge_key(p.node[i], p.node[j]));
            const Vec3 m = mid == mids_.end() ? Vec3((input(p.node[i]) + input(p.node[j])) / 2) : mid->second;
            x += 4 * p.weight[i] * p.weight[j] * m;
        }
    }
    return x;
}

}  // namespace femscalpel
