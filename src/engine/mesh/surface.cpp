// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/surface.h"

#include <algorithm>
#include <map>

#include "mesh/band_mesh.h"

namespace femscalpel {
namespace {

/// Calls visit(nodes) for the elements with so many corners, simplices of that dimension, that reach into the box.
void for_each_in(const Mesh& mesh, int corners, const Eigen::AlignedBox3d& box, auto visit) {
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (!t.simplex || t.dimension != corners - 1) continue;
        const Index* n = b.connectivity.data();
        for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
            Eigen::AlignedBox3d own;
            for (int k = 0; k < corners; ++k) own.extend(mesh.points[n[k]]);
            if (own.intersects(box)) visit(n);
        }
    }
}

}  // namespace

std::vector<SurfaceFace> surface_near(const Mesh& mesh, const Eigen::AlignedBox3d& box) {
    // A face that reaches into the box has only neighbours that do.
    std::vector<std::pair<FaceKey, FaceKey>> faces;
    for_each_in(mesh, 4, box, [&](const Index* n) {
        for (const auto& f : outward_faces) {
            const FaceKey face{n[f[0]], n[f[1]], n[f[2]]};
            faces.push_back({face_key(face), face});
        }
    });
    std::ranges::sort(faces);
    std::vector<SurfaceFace> out;
    for (std::size_t k = 0; k < faces.size();) {
        std::size_t end = k + 1;
        while (end < faces.size() && faces[end].first == faces[k].first) ++end;
        Eigen::AlignedBox3d own;
        for (const Index n : faces[k].second) own.extend(mesh.points[n]);
        if (end == k + 1 && own.intersects(box)) out.push_back({faces[k].second, false});
        k = end;
    }
    for_each_in(mesh, 3, box, [&](const Index* n) {
        const FaceKey face{n[0], n[1], n[2]}, key = face_key(face);
        const auto found = std::ranges::lower_bound(faces, key, {}, &std::pair<FaceKey, FaceKey>::first);
        if (found == faces.end() || found->first != key) out.push_back({face, true});
    });
    return out;
}

FaceKey face_key(FaceKey face) {
    std::ranges::sort(face);
    return face;
}

Eigen::AlignedBox3d grown(Eigen::AlignedBox3d box, double by) {
    box.min().array() -= by;
    box.max().array() += by;
    return box;
}

Eigen::AlignedBox3d box_around(const Mesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const CellBlock& b : mesh.blocks())
        for (const Index n : b.connectivity) box.extend(mesh.points[n]);
    return box;
}

}  // namespace femscalpel
