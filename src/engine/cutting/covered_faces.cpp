// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/covered_faces.h"

#include <algorithm>
#include <map>
#include <set>

#include "cancel.h"
#include "mesh/stopwatch.h"
#include "mesh/surface_tree.h"
#include "mesh/union_find.h"

namespace femscalpel {
namespace {

/// Cosine of the angle between normals up to which faces that lie on each other face the same way.
constexpr double same_way = 0.8;

}  // namespace

std::vector<SurfaceFace> covered_faces(const Mesh& mesh, const Mesh& other,
                                       const std::vector<std::array<Index, 2>>& outline, double tolerance,
                                       bool gives_way) {
    const std::vector<SurfaceFace> faces = surface_near(mesh, grown(box_around(other), tolerance));
    Eigen::AlignedBox3d around;
    for (const SurfaceFace& f : faces)
        for (const Index n : f.nodes) around.extend(mesh.points[n]);
    if (faces.empty()) return {};
    const double margin = tolerance + 0.1 * around.diagonal().norm();
    const std::vector<SurfaceFace> of_other = surface_near(other, grown(around, margin));
    const SurfaceTree tree(other, of_other);

    std::set<std::pair<Index, Index>> bound;
    for (const auto& [a, b] : outline) bound.insert(std::minmax(a, b));
    UnionFind regions(faces.size());
    std::map<std::pair<Index, Index>, int> at_edge;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::pair<Index, Index> edge = std::minmax(faces[f].nodes[k], faces[f].nodes[(k + 1) % 3]);
            if (bound.contains(edge)) continue;
            if (const auto [found, fresh] = at_edge.emplace(edge, f); !fresh) regions.unite(found->second, f);
        }
    std::map<int, double> votes;  // covered area less the rest
    SparseCheck check(64);
    for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
        check();
        const Vec3 &a = mesh.points[faces[f].nodes[0]], &b = mesh.points[faces[f].nodes[1]],
                   &c = mesh.points[faces[f].nodes[2]];
        const Vec3 middle = (a + b + c) / 3, normal = (b - a).cross(c - a);
        bool covered = tree.signed_distance(middle) <= tolerance;
        if (covered && !gives_way) {
            const SurfaceTree::Foot foot = tree.closest(middle);
            covered = foot.distance > tolerance || normal.normalized().dot(tree.normal(foot.piece)) < same_way;
        }
        votes[regions.find(f)] += (covered ? 1 : -1) * normal.norm() / 2;
    }
    std::vector<SurfaceFace> out;
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
        if (votes[regions.find(f)] > 0) out.push_back(faces[f]);
    return out;
}

}  // namespace femscalpel
