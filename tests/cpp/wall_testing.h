// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "cutting/wall_motion.h"
#include "whole_workpiece.h"

namespace femscalpel::checks {

/// The faces of the skin (of shells: edges of the border) all of whose nodes are chosen.
inline Covered covered_where(Mesh mesh, const std::function<bool(const Vec3&)>& chosen) {
    const FamilyIndex family = family_of(mesh, "CHOSEN", GroupKind::node);
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
        if (chosen(mesh.points[n])) mesh.node_families[n] = family;
    return covered_by(mesh, *mesh.find_group("CHOSEN"));
}

/// A workpiece of a whole mesh with a wall released in it.
struct WithWall {
    Mesh mesh;
    Workpiece f = whole_workpiece(mesh, away);
    Wall wall;

    WithWall(Mesh m, const std::function<bool(const Vec3&)>& chosen)
        : mesh(std::move(m)), wall(release_wall(f, covered_where(mesh, chosen))) {
        go_on_beside(f, wall);
    }
};

/// Of a solid's band.
inline double volume(const Workpiece& f) {
    double sum = 0;
    for (int t = 0; t < f.d.band.tetras.size(); ++t) {
        if (!f.d.band.tetras.alive(t)) continue;
        const auto& v = f.d.band.tetras[t];
        const auto at = [&](int k) { return f.d.band.nodes[v[k]].at; };
        sum += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
    }
    return sum;
}

}  // namespace femscalpel::checks
