// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/closest_point.h"

namespace femscalpel {
namespace {

using Box = Eigen::AlignedBox3d;

/// Cosine of the angle by which a solid's skin turns at its border.
const double crease = std::cos(30 * M_PI / 180);
/// The largest angle between faces of a smooth surface.
constexpr double smooth = 40 * M_PI / 180;

/// For Eigen's BVMinimize: the piece closest to a point, by `foot(piece)`.
template <class FootOf>
struct Search {
    using Scalar = double;
    const Vec3& x;
    FootOf foot_of;
    SurfaceTree::Foot best{Vec3::Zero(), std::numeric_limits<double>::infinity(), -1};

    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVMinimize() calls them.
    double minimumOnVolume(const Box& box) const { return box.exteriorDistance(x); }
    double minimumOnObject(int piece) {
        const Vec3 at = foot_of(piece);
        const double distance = (at - x).norm();
        if (distance < best.distance) best = {at, distance, piece};
        return distance;
    }
    // NOLINTEND(readability-identifier-naming)
};

SurfaceTree::Foot search(const Eigen::KdBVH<double, 3, int>& tree, const Vec3& x, auto foot_of) {
    Search<decltype(foot_of)> search{x, foot_of};
    Eigen::BVMinimize(tree, search);
    return search.best;
}

}  // namespace

SurfaceTree::SurfaceTree(const Mesh& mesh, std::span<const SurfaceFace> faces) : mesh_(mesh), faces_(faces) {
    std::vector<int> pieces;
    std::vector<Box> boxes;
    std::map<std::pair<Index, Index>, std::vector<int>> edges;  // their faces
    for (std::size_t f = 0; f < faces.size(); ++f) {
        Box& box = boxes.emplace_back();
        for (const Index n : faces[f].nodes) around_[n].push_back(static_cast<int>(f));
        pieces.push_back(static_cast<int>(f));
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = faces[f].nodes[k], b = faces[f].nodes[(k + 1) % 3];
            box.extend(mesh.points[a]);
            edges[std::minmax(a, b)].push_back(static_cast<int>(f));
        }
    }
    face_tree_.init(pieces.begin(), pieces.end(), boxes.begin(), boxes.end());
    pieces.clear();
    boxes.clear();
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = faces[f].nodes[k], b = faces[f].nodes[(k + 1) % 3];
            const std::vector<int>& here = edges[std::minmax(a, b)];
            if (here.front() != static_cast<int>(f) || !is_border(here)) continue;
            pieces.push_back(static_cast<int>(border_.size()));
            border_.push_back({a, b});
            border_faces_.push_back(static_cast<int>(f));
            Vec3 sum = Vec3::Zero();
            for (const int g : here) sum += normal(g);
            border_normals_.push_back(sum.norm() > 0.1 ? sum.normalized() : normal(here.front()));
            boxes.emplace_back(mesh.points[a].cwiseMin(mesh.points[b]), mesh.points[a].cwiseMax(mesh.points[b]));
        }
    border_tree_.init(pieces.begin(), pieces.end(), boxes.begin(), boxes.end());
    find_sags(edges);
}

/// Whether an edge with these faces belongs to the border.
bool SurfaceTree::is_border(const std::vector<int>& faces) const {
    if (faces.size() != 2) return faces.size() == 1;
    return !faces_[faces[0]].shell && !faces_[faces[1]].shell && normal(faces[0]).dot(normal(faces[1])) < crease;
}

void SurfaceTree::find_sags(const std::map<std::pair<Index, Index>, std::vector<int>>& edges) {
    sags_.assign(faces_.size(), 0);
    for (const auto& [edge, faces] : edges) {
        if (faces.size() != 2) continue;
        const Vec3 a = normal(faces[0]), b = normal(faces[1]);
        const double turn = std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
        if (turn > smooth) continue;
        // An arc of a chord h that turns by as much as the normals do is h turn / 8 off it.
        for (const int f : faces) sags_[f] = std::max(sags_[f], size(f) * turn / 8);
    }
}

SurfaceTree::Foot SurfaceTree::closest(const Vec3& x) const {
    if (faces_.empty()) return {Vec3::Zero(), std::numeric_limits<double>::infinity(), -1};
    return search(face_tree_, x, [&](int f) {
        const auto& n = faces_[f].nodes;
        Vec3 bary;
        return closest_on_triangle(mesh_.points[n[0]], mesh_.points[n[1]], mesh_.points[n[2]], x, bary);
    });
}

double SurfaceTree::signed_distance(const Vec3& x) const {
    const Foot foot = closest(x);
    if (foot.piece < 0) return foot.distance;
    // At an edge or a corner the face that is seen most from the front has the say.
    double side = 0;
    const double near = foot.distance * (1 + 1e-9) + 1e-12 * size(foot.piece);
    const auto look = [&](int f) {
        const auto& n = faces_[f].nodes;
        Vec3 bary;
        const Vec3 off = x - closest_on_triangle(mesh_.points[n[0]], mesh_.points[n[1]], mesh_.points[n[2]], x, bary);
        if (off.norm() > near) return;
        if (const double d = normal(f).dot(off); std::abs(d) > std::abs(side)) side = d;
    };
    for (const Index n : faces_[foot.piece].nodes)
        for (const int f : around_.at(n)) look(f);
    return std::copysign(foot.distance, side);
}

SurfaceTree::Foot SurfaceTree::closest_on_border(const Vec3& x) const {
    if (border_.empty()) return {Vec3::Zero(), std::numeric_limits<double>::infinity(), -1};
    return search(border_tree_, x, [&](int e) {
        return closest_on_segment(mesh_.points[border_[e].first], mesh_.points[border_[e].second], x);
    });
}

Vec3 SurfaceTree::normal(int face) const {
    const auto& n = faces_[face].nodes;
    return (mesh_.points[n[1]] - mesh_.points[n[0]]).cross(mesh_.points[n[2]] - mesh_.points[n[0]]).normalized();
}

double SurfaceTree::size(int face) const {
    const auto& n = faces_[face].nodes;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (mesh_.points[n[k]] - mesh_.points[n[(k + 1) % 3]]).norm();
    return sum / 3;
}

}  // namespace femscalpel
