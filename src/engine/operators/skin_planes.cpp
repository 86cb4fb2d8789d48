// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/skin_planes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <set>

#include "cancel.h"
#include "mesh/union_find.h"

namespace femscalpel {
namespace {

using SkinTriangle = std::array<Index, 3>;

Vec3 area_of(const Mesh& mesh, const SkinTriangle& t) {
    return (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
}

}  // namespace

SkinPlanes::SkinPlanes(const Mesh& mesh, std::span<const SkinTriangle> skin) : slack_(mesh) {
    if (slack_.off() == 0) return;
    struct Side {
        std::array<Index, 2> edge;  // ascending
        int triangle;
    };
    std::vector<Side> sides;
    std::vector<Vec3> normals;
    std::vector<double> off;
    sides.reserve(3 * skin.size());
    SparseCheck check;
    for (const SkinTriangle& t : skin) {
        check();
        for (int k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<int>(normals.size())});
        }
        normals.push_back(area_of(mesh, t).normalized());
        off.push_back(slack_.normal(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
    }
    std::ranges::sort(sides, {}, [](const Side& s) { return std::pair(s.edge, s.triangle); });
    UnionFind parts(skin.size());
    for (std::size_t k = 1; k < sides.size(); ++k) {
        const int one = sides[k - 1].triangle, other = sides[k].triangle;
        if (sides[k].edge == sides[k - 1].edge &&
            (normals[one] - normals[other]).norm() <= 1e-6 + off[one] + off[other])
            parts.unite(one, other);
    }
    std::map<int, std::vector<SkinTriangle>> triangles;
    for (int k = 0; k < static_cast<int>(skin.size()); ++k) triangles[parts.find(k)].push_back(skin[k]);
    for (const auto& [first, part] : triangles) {
        check();
        for (const SkinTriangle& t : part) part_[t] = planes_.size();
        planes_.push_back(fit(mesh, part));
    }
}

/// The plane of least squares.
std::optional<SkinPlanes::Plane> SkinPlanes::fit(const Mesh& mesh, std::span<const SkinTriangle> part) const {
    std::set<Index> nodes;
    Vec3 outwards = Vec3::Zero(), middle = Vec3::Zero();
    for (const SkinTriangle& t : part) {
        nodes.insert(t.begin(), t.end());
        outwards += area_of(mesh, t);
    }
    for (const Index n : nodes) middle += mesh.points[n];
    middle /= static_cast<double>(nodes.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Index n : nodes) spread += (mesh.points[n] - middle) * (mesh.points[n] - middle).transpose();
    Vec3 normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
    if (normal.dot(outwards) < 0) normal = -normal;
    const double offset = normal.dot(middle);
    const bool is_plane = std::ranges::all_of(
        nodes, [&](Index n) { return std::abs(normal.dot(mesh.points[n]) - offset) <= 2 * slack_.off(); });
    return is_plane ? std::optional(Plane{normal, offset}) : std::nullopt;
}

std::optional<SkinPlanes::Plane> SkinPlanes::of(const SkinTriangle& triangle) const {
    const auto found = part_.find(triangle);
    return found == part_.end() ? std::nullopt : planes_[found->second];
}

}  // namespace femscalpel
