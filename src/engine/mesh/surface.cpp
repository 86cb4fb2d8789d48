// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/surface.h"

#include <algorithm>

#include "mesh/outer_faces.h"

namespace femscalpel {

std::vector<SurfaceFace> surface_near(const Mesh& mesh, const Eigen::AlignedBox3d& box) {
    return outer_faces(mesh, box).triangles;
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
