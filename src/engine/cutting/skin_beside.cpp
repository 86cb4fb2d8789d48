// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/skin_beside.h"

#include <algorithm>
#include <utility>

namespace femscalpel {

/// For Eigen's BVIntersect: where a path passes faces.
struct SkinBeside::Hits {
    // NOLINTBEGIN(readability-identifier-naming): so Eigen's BVIntersect() calls them.
    bool intersectVolume(const Eigen::AlignedBox3d& b) const { return b.intersects(box); }
    bool intersectObject(int face) {
        const int s = skin.slots_[face];
        const Vec3 &a = skin.corner(s, 0), ab = skin.corner(s, 1) - a, ac = skin.corner(s, 2) - a;
        // Möller & Trumbore, "Fast, minimum storage ray/triangle intersection", J. Graphics Tools 2, 1997
        const Vec3 p = way.cross(ac);
        const double volume = ab.dot(p);
        if (volume == 0) return false;
        const Vec3 d = from - a, q = d.cross(ab);
        const double u = d.dot(p) / volume, v = way.dot(q) / volume, at = ac.dot(q) / volume;
        if (u >= 0 && v >= 0 && u + v <= 1 && at > 0 && at <= 1)
            found.emplace_back(at, way.dot(skin.outwards_[face]) > 0);
        return false;
    }
    // NOLINTEND(readability-identifier-naming)

    const SkinBeside& skin;
    Vec3 from, way;
    Eigen::AlignedBox3d box;
    std::vector<std::pair<double, bool>> found;  // how far along the way, and whether it leaves the material there
};

SkinBeside::SkinBeside(const BandMesh& band) : band_(band) {
    std::vector<int> faces;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (int s = 0; s < band.skin.size(); ++s) {
        if (!band.skin.alive(s)) continue;
        const Vec3 out = outwards(s);
        if (out.isZero(0)) continue;
        faces.push_back(static_cast<int>(outwards_.size()));
        slots_.push_back(s);
        outwards_.push_back(out);
        boxes.emplace_back(corner(s, 0));
        boxes.back().extend(corner(s, 1)).extend(corner(s, 2));
    }
    tree_.init(faces.begin(), faces.end(), boxes.begin(), boxes.end());
}

std::optional<Vec3> SkinBeside::exit(const Vec3& from, const Vec3& to, double length) const {
    Hits hits{*this, from, to - from, Eigen::AlignedBox3d(from).extend(to), {}};
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

/// Normal of a face out of its tetrahedron; zero for one between two.
Vec3 SkinBeside::outwards(int slot) const {
    const auto& face = band_.skin[slot];
    Vec3 out = Vec3::Zero();
    int tetras = 0;
    for (const int t : band_.tetras.around(face[0])) {
        const auto& n = band_.tetras[t];
        const auto has = [&](int v) { return std::ranges::find(n, v) != n.end(); };
        if (!has(face[1]) || !has(face[2])) continue;
        ++tetras;
        const Vec3& a = corner(slot, 0);
        out = (corner(slot, 1) - a).cross(corner(slot, 2) - a);
        for (const int v : n)
            if (std::ranges::find(face, v) == face.end() && out.dot(band_.nodes[v].at - a) > 0) out = -out;
    }
    return tetras == 1 ? out : Vec3::Zero();
}

}  // namespace femscalpel
