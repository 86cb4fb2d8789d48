// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <numbers>

#include "mesh/mesh.h"

/// The holes that the quality of drill() is measured by, in the two glued boxes of 10 x 10 x 10 that meet at x = 10;
/// for the test and the benchmark.
namespace femscalpel::checks {

struct ReferenceHole {
    const char* name;
    Vec3 origin, axis;
    double radius;
    double quality;  ///< least mean ratio wanted near it
};

inline const ReferenceHole reference_holes[] = {
    {"through_the_glue_plane", {10, 5, 5}, {0, 0, 1}, 2.0, 0.40},
    {"in_one_box", {6, 5, 5}, {0, 1, 0}, 2.0, 0.40},
    {"finer_than_39k", {6, 5, 5}, {0, 0, 1}, 0.6, 0.40},
    {"oblique", {10, 5, 5}, {0.3, 0.2, 1}, 1.2, 0.25},
};

struct HoleMeasures {
    double volume_error;  ///< removed volume against the exact cylinder's, relative
    double off_wall;      ///< largest distance of a node of HOLE_WALL from the cylinder
    double off_border;    ///< largest distance of a node that elements of both boxes have from the plane between them
    Index wall_faces;
};

inline double tetra_volume(const Mesh& mesh) {
    double sum = 0;
    const CellBlock& block = mesh.block(CellType::tetra);
    for (Index c = 0; c < block.size(); ++c) {
        const auto n = block.nodes(c);
        const Vec3& a = mesh.points[n[0]];
        sum += (mesh.points[n[1]] - a).cross(mesh.points[n[2]] - a).dot(mesh.points[n[3]] - a) / 6;
    }
    return sum;
}

/// Looks at a hole from the outside. The mesh is linear and has the element groups LEFT and RIGHT.
inline HoleMeasures measure(const ReferenceHole& hole, const Mesh& before, const Mesh& after) {
    HoleMeasures out{};
    const Vec3 axis = hole.axis.normalized();
    // Along z or y the boxes are 10 thick; the oblique hole leaves by the faces normal to z.
    const double length = 10 / axis.cwiseAbs().maxCoeff();
    out.volume_error =
        (tetra_volume(before) - tetra_volume(after)) / (std::numbers::pi * hole.radius * hole.radius * length) - 1;
    const GroupIndex wall = *after.find_group("HOLE_WALL", GroupKind::element);
    const CellBlock& triangles = after.block(CellType::triangle);
    for (Index c = 0; c < triangles.size(); ++c) {
        if (!after.families.contains(triangles.families[c], wall)) continue;
        ++out.wall_faces;
        for (const Index n : triangles.nodes(c)) {
            const Vec3 r = after.points[n] - hole.origin;
            out.off_wall = std::max(out.off_wall, std::abs((r - axis.dot(r) * axis).norm() - hole.radius));
        }
    }
    std::vector<char> in(after.points.size(), 0);
    const CellBlock& tetras = after.block(CellType::tetra);
    const GroupIndex left = *after.find_group("LEFT", GroupKind::element),
                     right = *after.find_group("RIGHT", GroupKind::element);
    for (Index c = 0; c < tetras.size(); ++c)
        for (const Index n : tetras.nodes(c))
            in[n] |= static_cast<char>((after.families.contains(tetras.families[c], left) ? 1 : 0) |
                                       (after.families.contains(tetras.families[c], right) ? 2 : 0));
    for (std::size_t n = 0; n < in.size(); ++n)
        if (in[n] == 3) out.off_border = std::max(out.off_border, std::abs(after.points[n].x() - 10));
    return out;
}

}  // namespace femscalpel::checks
