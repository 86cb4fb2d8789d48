// SPDX-License-Identifier: LGPL-2.1-or-later
#include "whole_workpiece.h"

#include <cmath>
#include <cstdint>

namespace femscalpel::checks {

Workpiece whole_workpiece(const Mesh& mesh, const Tool& tool) {
    const std::vector<std::int8_t> level(mesh.points.size(), 0);
    Workpiece f{.d = Deformable(extract_band(mesh, level), mesh, {}), .tool = &tool, .tolerance = 1e-9};
    for (int v = 0; v < f.d.band.size(); ++v) {
        const double off = tool.distance(f.d.band.nodes[v].at);
        const bool on = std::abs(off) <= f.tolerance;
        f.distance.push_back(on ? 0 : off);
        if (on) f.d.contact[v] = &tool;
    }
    return f;
}

int node_at(const BandMesh& band, const Vec3& at) {
    for (int v = 0; v < band.size(); ++v)
        if ((band.nodes[v].at - at).norm() < 1e-9) return v;
    throw Error("no node there");
}

}  // namespace femscalpel::checks
