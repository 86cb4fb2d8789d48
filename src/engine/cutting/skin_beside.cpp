// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/skin_beside.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace femscalpel {
namespace {

/// Shells at a smaller angle than this (cosine) to each other go on in one another.
constexpr double in_plane = 0.5;

/// Normal of a face out of its tetrahedron; zero for one between two.
Vec3 outwards_of_face(const BandMesh& band, const std::array<int, 3>& face) {
    const auto at = [&](int k) -> const Vec3& { return band.nodes[face[k]].at; };
    Vec3 out = Vec3::Zero();
    int tetras = 0;
    for (const int t : band.tetras.around(face[0])) {
        const auto& n = band.tetras[t];
        const auto has = [&](int v) { return std::ranges::find(n, v) != n.end(); };
        if (!has(face[1]) || !has(face[2])) continue;
        ++tetras;
        out = (at(1) - at(0)).cross(at(2) - at(0));
        for (const int v : n)
            if (std::ranges::find(face, v) == face.end() && out.dot(band.nodes[v].at - at(0)) > 0) out = -out;
    }
    return tetras == 1 ? out : Vec3::Zero();
}

/// The only shell triangle with an edge, or -1.
int only_shell(const Deformable& d, const std::array<int, 2>& edge) {
    int found = -1;
    for (const int t : d.band.triangles.around(edge[0])) {
        const auto& n = d.band.triangles[t];
        if (!d.constraints.is_shell(d.band.triangles.origin(t)) || std::ranges::find(n, edge[1]) == n.end()) continue;
        if (found >= 0) return -1;
        found = t;
    }
    return found;
}

}  // namespace

/// For Eigen's BVIntersect: where a path passes faces.
struct SkinBeside::Hits {
    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVIntersect() calls them.
    bool intersectVolume(const Eigen::AlignedBox3d& b) const { return b.intersects(box); }
    bool intersectObject(int k) {
        const Face& face = faces[k];
        if (std::abs(face.shell_normal.dot(normal)) < in_plane * normal.norm()) return false;
        const Vec3 &a = face.corner[0], ab = face.corner[1] - a, ac = face.corner[2] - a;
        // Möller & Trumbore, "Fast, minimum storage ray/triangle intersection", J. Graphics Tools 2, 1997
        const Vec3 p = way.cross(ac);
        const double volume = ab.dot(p);
        if (volume == 0) return false;
        const Vec3 d = from - a, q = d.cross(ab);
        const double u = d.dot(p) / volume, v = way.dot(q) / volume, at = ac.dot(q) / volume;
        if (u >= 0 && v >= 0 && u + v <= 1 && at > 0 && at <= 1) found.emplace_back(at, way.dot(face.outwards) > 0);
        return false;
    }
    // NOLINTEND(readability-identifier-naming)

    const std::vector<Face>& faces;
    Vec3 from, way, normal;
    Eigen::AlignedBox3d box;
    std::vector<std::pair<double, bool>> found;  // how far along the way, and whether it leaves the material there
};

SkinBeside::SkinBeside(std::vector<Face> faces) : faces_(std::move(faces)) {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const Face& face : faces_) {
        boxes.emplace_back(face.corner[0]);
        boxes.back().extend(face.corner[1]).extend(face.corner[2]);
    }
    std::vector<int> objects(faces_.size());
    std::iota(objects.begin(), objects.end(), 0);
    tree_.init(objects.begin(), objects.end(), boxes.begin(), boxes.end());
}

SkinBeside SkinBeside::of_solid(const BandMesh& band) {
    std::vector<Face> faces;
    for (int s = 0; s < band.skin.size(); ++s) {
        if (!band.skin.alive(s)) continue;
        const auto& n = band.skin[s];
        if (const Vec3 out = outwards_of_face(band, n); !out.isZero(0))
            faces.push_back({{band.nodes[n[0]].at, band.nodes[n[1]].at, band.nodes[n[2]].at}, out});
    }
    return SkinBeside(std::move(faces));
}

SkinBeside SkinBeside::of_shells(const Deformable& d) {
    std::vector<Face> faces;
    for (int s = 0; s < d.band.creases.size(); ++s) {
        if (!d.band.creases.alive(s)) continue;
        const auto& edge = d.band.creases[s];
        const int t = only_shell(d, edge);
        if (t < 0) continue;
        const Vec3 &a = d.band.nodes[edge[0]].at, &b = d.band.nodes[edge[1]].at;
        const Vec3 normal = d.shell_normals[d.band.triangles.origin(t)], up = (b - a).norm() * normal;
        Vec3 out = (b - a).cross(normal);
        for (const int v : d.band.triangles[t])
            if (v != edge[0] && v != edge[1] && out.dot(d.band.nodes[v].at - a) > 0) out = -out;
        faces.push_back({{a - up, b - up, b + up}, out, normal});
        faces.push_back({{a - up, b + up, a + up}, out, normal});
    }
    return SkinBeside(std::move(faces));
}

std::optional<Vec3> SkinBeside::exit(const Vec3& from, const Vec3& to, double length, const Vec3& normal) const {
    Hits hits{faces_, from, to - from, normal, Eigen::AlignedBox3d(from).extend(to), {}};
    Eigen::BVIntersect(tree_, hits);
    std::ranges::sort(hits.found);
    for (std::size_t k = 0; k < hits.found.size(); ++k) {
        const auto& [at, leaves] = hits.found[k];
        if (!leaves && k == 0) return {};  // it led out from the beginning
        const double next = k + 1 < hits.found.size() ? hits.found[k + 1].first : 1;
        if (leaves && (next - at) * (to - from).norm() > length) return Vec3(from + at * (to - from));
    }
    return {};
}

}  // namespace femscalpel
